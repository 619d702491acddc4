#!/usr/bin/env bash
# Builds the program of docs/user/embedding.md as the page describes, with only an installed Candela: with g++ and Candela's own compiler,
# with CMake and with pkg-config. It must render the same as the command.
#   embedding.sh PREFIX SCRATCH_DIR CMAKE CXX
set -euo pipefail
prefix=$1 scratch=$2 cmake=$3 cxx=$4
page=$(cd "$(dirname "$0")/../.." && pwd)/docs/user/embedding.md
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }
# block LANGUAGE: the page's block of that language.
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$page" | sed '1d;$d'; }

rm -rf "$scratch"
mkdir -p "$scratch/project"
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig LD_LIBRARY_PATH=$prefix/lib
unset CMAKE_GENERATOR
block cpp >"$scratch/project/shot.cpp"
block cmake >"$scratch/project/CMakeLists.txt"
[ "$(block sh)" = 'g++ -std=c++20 shot.cpp -o shot $(pkg-config --cflags --libs candela)' ] || fail "the page gives another command"

printf 'version = 1\n[image]\nwidth = 320\n[observer]\nposition = [1, 2, 4]\nlook_at = [0, 0, 0]\n[[light]]\ntype = "point"\nposition = [2, 2, 3]\n[[object]]\ntype = "torus"\n' \
    >"$scratch/scene.toml"
printf '[shading]\nmodel = "gouraud"\n[reflection]\nmodel = "lambert"\n' >>"$scratch/scene.toml"
quiet "$prefix/bin/candela" render "$scratch/scene.toml" -o "$scratch/expected.ppm"

for compiler in g++ "$cxx"; do
    command -v "$compiler" >/dev/null || { echo "SKIPPED: $compiler is not installed"; exit 77; }
    for generator in Ninja 'Unix Makefiles'; do
        build=$scratch/${compiler##*/}-${generator// /-}
        quiet "$cmake" -G "$generator" -S "$scratch/project" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix"
        quiet "$cmake" --build "$build"
        "$build/shot" "$scratch/scene.toml" >"$scratch/shot.ppm" || fail "running what $compiler built with $generator"
        cmp "$scratch/expected.ppm" "$scratch/shot.ppm" || fail "$compiler with $generator: the picture differs from the command's"
    done
    (cd "$scratch/project" && eval "$(block sh | sed "s|^g++|'$compiler'|")") >"$scratch/log" 2>&1 ||
        { cat "$scratch/log" >&2; fail "$compiler with pkg-config"; }
    "$scratch/project/shot" >"$scratch/shot.ppm" || fail "running what $compiler built with pkg-config"
    # A ball in front of black has more than one colour.
    [ "$(tail -c +16 "$scratch/shot.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 50 ] || fail "the scene made in code is empty"
    code=0
    "$scratch/project/shot" "$scratch/missing.toml" >/dev/null 2>"$scratch/log" || code=$?
    { [ "$code" -eq 1 ] && grep -q "missing.toml" "$scratch/log"; } || { cat "$scratch/log" >&2; fail "a missing file: exit code $code"; }
done
echo "== all well"
