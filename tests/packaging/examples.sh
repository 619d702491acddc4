#!/usr/bin/env bash
# With only an installed Candela: builds the plugins of docs/examples/plugins as installed with the documentation, tests them, runs the
# conformance kit on them, renders with them, and verifies them on all targets.
# Then builds them with other compilers, which must render the same.
#   examples.sh BUILD_DIR SCRATCH_DIR CMAKE CXX [OTHER_CXX...]
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

rm -rf "$scratch"
mkdir -p "$scratch/home"
"$cmake" --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/prefix"
prefix=$scratch/prefix
export PATH=$prefix/bin:$PATH HOME=$scratch/home XDG_DATA_HOME=$scratch/home/data
cp -rL "$prefix/share/doc/candela-dev/examples/plugins" "$scratch/plugins" || fail "the examples are not installed"
cd "$scratch/plugins"
names=(*/CMakeLists.txt)
names=("${names[@]%/*}")
[ ${#names[@]} -ge 14 ] || fail "there are ${#names[@]} examples; expected fourteen"

# build_all COMPILER FOLDER
build_all() {
    quiet "$cmake" -G Ninja -S . -B "$2" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$1" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror"
    quiet "$cmake" --build "$2"
    (cd "$2" && quiet "$(dirname "$cmake")/ctest" -j2 --output-on-failure)
    [ "$(grep -c ' Passed ' "$scratch/log")" -eq $((2 * ${#names[@]})) ] || { cat "$scratch/log" >&2; fail "not two tests for each"; }
}

say "all in one build, with its own test and the kit for each: ${names[*]}"
build_all "$cxx" build

say "one of them as a project of its own, which its README shows"
(cd qoi && sed -n "/^cmake -B/,/^candela render/p" README.md >run.sh)
(cd qoi && CXX=$cxx CMAKE_PREFIX_PATH=$prefix quiet bash -e run.sh)
[ "$(head -c 4 qoi/picture.qoi)" = qoif ] || fail "no QOI picture was rendered"

say "each is listed, described, and renders"
for name in "${names[@]}"; do
    library=$(basename build/plugins/*-"$name".so .so)
    quiet candela describe "${library%-"$name"}/$name" --plugin-dir build/plugins
    # The last command of its README renders with it.
    sed -n '/^candela render/,/^```/p' "$name/README.md" | grep -v '^```' | sed 's|--plugin-dir build|--plugin-dir ../build/plugins|' \
        >"$scratch/render.sh"
    (cd "$name" && quiet bash -e "$scratch/render.sh")
done

say "together they make a picture, and generated programs make the same"
quiet candela render gallery.toml --plugin-dir build/plugins -o gallery.png
for name in "${names[@]}"; do
    case $name in
        qoi | eulumdat | retroreflector) ;;  # in no scene that programs are generated from
        *) grep -q "\"$name\"" gallery.toml || fail "$name is not in gallery.toml" ;;
    esac
done
for target in cpp opengl webgl; do
    quiet candela verify gallery.toml --target $target --plugin-dir build/plugins --width 160 --height 80
    grep -q match "$scratch/log" || { cat "$scratch/log" >&2; fail "$target was not verified"; }
done

for other in "${@:5}"; do
    command -v "$other" >/dev/null || { say "SKIPPED: $other is not installed"; continue; }
    say "built by $other, they pass their tests, conform, and render the same"
    build_all "$other" "build-$other"
    quiet candela render gallery.toml --plugin-dir "build-$other/plugins" -o "gallery-$other.png"
    quiet candela diff gallery.png "gallery-$other.png" --tolerance 1
done

say "a light with a table made from a file is part of generated programs, which do not read the file"
mkdir "$scratch/lamp"
cp eulumdat/downlight.ldt "$scratch/lamp"
for target in cpp opengl webgl; do
    quiet candela verify --target $target --plugin-dir build/plugins --width 160 --height 80 --set light.lamp.type=eulumdat \
        --set 'light.lamp.direction=[0,-1,-1]' --set light.lamp.file="$scratch/lamp/downlight.ldt"
    grep -q match "$scratch/log" || { cat "$scratch/log" >&2; fail "$target was not verified with a table"; }
done
quiet candela generate --target cpp --plugin-dir build/plugins --set light.lamp.type=eulumdat --set 'light.lamp.direction=[0,-1,-1]' \
    --set light.lamp.file="$scratch/lamp/downlight.ldt" -o "$scratch/program"
! grep -rq downlight "$scratch/program" || fail "the generated program mentions the file"
say "the triangle that a shading model reads is explained"
quiet candela explain --shading pn-normals --plugin-dir build/plugins --pixel 256,300
grep -q "pn_normals_of_edge" "$scratch/log" || { cat "$scratch/log" >&2; fail "the kernel's steps are not explained"; }

say "a model that reads its triangle may be lit per face, but not per vertex, since a vertex belongs to several triangles"
mkdir facets
for file in pn-normals/*; do
    sed 's/pn-normals/facets/g; s/pn_normals/facets/g; s|^/// reference:|/// rate: face\n&|' "$file" >"facets/$(basename "${file/%pn-normals*/facets${file##*pn-normals}}")"
done
quiet "$cmake" -G Ninja -S facets -B facets/build -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$prefix"
quiet "$cmake" --build facets/build
quiet candela plugin test facets/build/shading-facets.so
for target in cpp opengl webgl; do
    quiet candela verify --target $target --plugin-dir facets/build --shading facets --width 160 --height 120
    grep -q match "$scratch/log" || { cat "$scratch/log" >&2; fail "$target was not verified with a model that reads its triangle"; }
done
grep -q 'rate: face' facets/facets.kernel || fail "it is lit differently"
sed -i 's/rate: face/rate: vertex/' facets/facets.kernel
! "$cmake" --build facets/build >"$scratch/log" 2>&1 || fail "a model that is lit per vertex takes a Triangle"
grep -q "a vertex belongs to several" "$scratch/log" || { cat "$scratch/log" >&2; fail "the reason is not given"; }
say "all well"
