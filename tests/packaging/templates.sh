#!/usr/bin/env bash
# With only an installed Candela: makes, builds, tests, lists, renders with and removes a new plugin of each kind.
#   templates.sh BUILD_DIR SCRATCH_DIR CMAKE CXX      installs the build first
#   templates.sh --installed PREFIX SCRATCH_DIR CMAKE CXX [KIND...]      all kinds by default
set -euo pipefail
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

if [ "$1" = --installed ]; then
    prefix=$2 scratch=$3 cmake=$4 cxx=$5
    kinds=("${@:6}")
    rm -rf "$scratch"
    mkdir -p "$scratch"
else
    build=$1 scratch=$2 cmake=$3 cxx=$4
    rm -rf "$scratch"
    mkdir -p "$scratch"
    "$cmake" --install "$build" --prefix "$scratch/first" >/dev/null
    mv "$scratch/first" "$scratch/prefix"
    prefix=$scratch/prefix
    kinds=()
fi
[ ${#kinds[@]} -gt 0 ] || kinds=(light reflection shading shape image target)
export PATH=$prefix/bin:$PATH HOME=$scratch/home XDG_DATA_HOME=$scratch/home/data
mkdir -p "$HOME"
cd "$scratch"

for kind in "${kinds[@]}"; do
    name=try-$kind
    say "$kind: new, build, test"
    quiet candela plugin new "$kind" "$name"
    quiet "$cmake" -G Ninja -S "$name" -B "$name/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" \
        -DCMAKE_PREFIX_PATH="$prefix"
    quiet "$cmake" --build "$name/build"
    (cd "$name/build" && quiet "$(dirname "$cmake")/ctest" --output-on-failure)
    mv log tested
    grep -q "$kind/$name conforms .*Passed" tested || { cat tested >&2; fail "$name was not tested by the kit"; }
    [ "$(grep -c ": $kind/$name .*Passed" tested)" -eq 2 ] || { cat tested >&2; fail "$name has not two tests"; }
    [ "$(grep -c Passed tested)" -eq 2 ] || { cat tested >&2; fail "$name has tests other than these two"; }

    say "$kind: list, describe, render, for this user only"
    mkdir -p "$XDG_DATA_HOME/candela/plugins"
    cp "$name/build/$kind-$name".{so,json} "$XDG_DATA_HOME/candela/plugins"
    candela list "$kind" | grep -q "  $name " || fail "$name is not listed"
    candela describe "$kind/$name" >/dev/null
    plugins=$(candela plugin doctor)
    grep -q "in use: $kind/$name 0.1.0" <<<"$plugins" || fail "the doctor does not list $name"
    case $kind in
        # Its own scene, because other shapes do not have the default cube's size parameter.
        shape) quiet candela render "$name/scene.toml" -o "$name.png" ;;
        light) quiet candela render --set "light.lamp.type=$name" -o "$name.png" ;;
        image) quiet candela render -o "$name.$name"
               quiet candela render -o same.png
               quiet candela diff --tolerance 0 "$name.$name" same.png
               quiet candela render --set "image.environment=$name.$name" -o "$name.png" ;;
        target) quiet candela generate --target "$name" -o "$name.files"
                [ "$(grep -c '^f ' "$name.files/scene.obj")" -eq 12 ] || fail "a cube has twelve triangles"
                cp "$name.files/scene.obj" "$name.png" ;;
        *) quiet candela render "--$kind" "$name" -o "$name.png" ;;
    esac
    if grep -q warning "$scratch/log"; then cat "$scratch/log" >&2; fail "rendering with $name warns"; fi
    [ -s "$name.png" ] || fail "no picture"

    say "$kind: uninstall"
    rm "$XDG_DATA_HOME/candela/plugins/$kind-$name".*
    if candela describe "$kind/$name" 2>/dev/null; then fail "$name is still there"; fi
done

say "errors are reported"
for wrong in 'plugin new reflection Bad_Name' 'plugin new lihgt x' 'plugin new' 'plugin nwe'; do
    code=0
    # shellcheck disable=SC2086
    candela $wrong 2>"$scratch/log" || code=$?
    [ "$code" -eq 2 ] || fail "exit code $code for candela $wrong"
done
code=0
candela plugin new "${kinds[0]}" "try-${kinds[0]}" 2>"$scratch/log" || code=$?
{ [ "$code" -eq 1 ] && grep -q 'already exists' "$scratch/log"; } || fail "a project was overwritten"
code=0
candela plugin test "$scratch/none.so" 2>"$scratch/log" || code=$?
[ "$code" -eq 1 ] || fail "exit code $code for a missing plugin"
say "all well"
