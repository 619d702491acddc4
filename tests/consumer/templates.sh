#!/usr/bin/env bash
# With an installed Candela alone: a new plugin of each kind is made, built, tested, listed, rendered with and removed.
#   templates.sh BUILD_DIR SCRATCH_DIR CMAKE CXX      installs the build first
#   templates.sh --installed PREFIX SCRATCH_DIR CMAKE CXX [KIND...]      all kinds by default
# One kind is built as its project stands. Several are built within one project, so that the module interfaces, which take
# nearly all of the time, are built once; that each is a whole project is seen by configuring it alone.
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
[ ${#kinds[@]} -gt 0 ] || kinds=(light reflection shading shape)
export PATH=$prefix/bin:$PATH HOME=$scratch/home XDG_DATA_HOME=$scratch/home/data
mkdir -p "$HOME"
cd "$scratch"

configure() {
    quiet "$cmake" -G Ninja -S "$1" -B "$1/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" \
        -DCMAKE_PREFIX_PATH="$prefix"
}

for kind in "${kinds[@]}"; do
    say "$kind: new"
    quiet candela plugin new "$kind" "try-$kind"
    configure "try-$kind"
done

if [ ${#kinds[@]} -eq 1 ]; then
    project=try-${kinds[0]}
else
    project=together
    mkdir "$project"
    {
        # Found here, candela::core is one target for all of them, and so are its interfaces.
        printf 'cmake_minimum_required(VERSION 3.28)\nproject(together LANGUAGES CXX)\nenable_testing()\nfind_package(candela REQUIRED)\n'
        for kind in "${kinds[@]}"; do printf 'add_subdirectory(../try-%s try-%s)\n' "$kind" "$kind"; done
    } >"$project/CMakeLists.txt"
    configure "$project"
fi
say "build, test"
quiet "$cmake" --build "$project/build"
(cd "$project/build" && quiet "$(dirname "$cmake")/ctest" --output-on-failure)
mv log tested

for kind in "${kinds[@]}"; do
    name=try-$kind
    built=$project/build
    [ "$project" = "$name" ] || built+=/$name
    grep -q "$kind/$name conforms .*Passed" tested || { cat tested >&2; fail "$name was not put to the kit"; }
    [ "$(grep -c ": $kind/$name .*Passed" tested)" -eq 2 ] || { cat tested >&2; fail "$name has not two tests"; }

    say "$kind: list, describe, render, for this user alone"
    mkdir -p "$XDG_DATA_HOME/candela/plugins"
    cp "$built/$kind-$name".{so,json} "$XDG_DATA_HOME/candela/plugins"
    candela list "$kind" | grep -q "  $name " || fail "$name is not listed"
    candela describe "$kind/$name" >/dev/null
    plugins=$(candela plugin doctor)
    grep -q "in use: $kind/$name 0.1.0" <<<"$plugins" || fail "the doctor does not know $name"
    case $kind in
        # The default cube's size is no parameter of another shape.
        shape) printf 'version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n[[light]]\ntype = "point"\nposition = [2, 2, 3]\n[[object]]\ntype = "%s"\n' "$name" >shape.toml
               quiet candela render shape.toml --defaults -o "$name.png" ;;
        light) quiet candela render --set "light.lamp.type=$name" -o "$name.png" ;;
        *) quiet candela render "--$kind" "$name" -o "$name.png" ;;
    esac
    if grep -q warning "$scratch/log"; then cat "$scratch/log" >&2; fail "rendering with $name warns"; fi
    [ -s "$name.png" ] || fail "no picture"

    say "$kind: uninstall"
    rm "$XDG_DATA_HOME/candela/plugins/$kind-$name".*
    if candela describe "$kind/$name" 2>/dev/null; then fail "$name is still there"; fi
done
[ "$(grep -c Passed tested)" -eq $((2 * ${#kinds[@]})) ] || { cat tested >&2; fail "there are other tests than two for each kind"; }

say "what goes wrong is said"
for wrong in 'plugin new reflection Bad_Name' 'plugin new lihgt x' 'plugin new' 'plugin nwe'; do
    code=0
    # shellcheck disable=SC2086
    candela $wrong 2>"$scratch/log" || code=$?
    [ "$code" -eq 2 ] || fail "exit code $code for candela $wrong"
done
code=0
candela plugin new "${kinds[0]}" "try-${kinds[0]}" 2>"$scratch/log" || code=$?
{ [ "$code" -eq 1 ] && grep -q 'already there' "$scratch/log"; } || fail "a project was written over"
code=0
candela plugin test "$scratch/none.so" 2>"$scratch/log" || code=$?
[ "$code" -eq 1 ] || fail "exit code $code for a plugin that is not there"
say "all well"
