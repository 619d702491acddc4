#!/usr/bin/env bash
# With only an installed Candela: builds the SDK's templates unchanged with compilers other than Candela's, other generators,
# standards and extensions, without module scanning. Each plugin must pass its tests, and render the same as the first case's.
#   compilers.sh BUILD_DIR SCRATCH_DIR CMAKE CASE...
# CASE is COMPILER,GENERATOR,STANDARD,EXTENSIONS,KIND[+KIND...]. Exit code 77: a compiler is missing, which it names.
set -euo pipefail
build=$1 scratch=$2 cmake=$3
here=$(cd "$(dirname "$0")" && pwd)
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

for case in "${@:4}"; do
    for tool in "${case%%,*}" make objdump; do
        command -v "$tool" >/dev/null || { echo "SKIPPED: $tool is not installed"; exit 77; }
    done
done
rm -rf "$scratch"
mkdir -p "$scratch/home"
prefix=$scratch/prefix
"$cmake" --install "$build" --prefix "$prefix" >/dev/null
export PATH=$prefix/bin:$PATH HOME=$scratch/home XDG_DATA_HOME=$scratch/home/data
unset CMAKE_GENERATOR
cd "$scratch"

render() {
    case $1 in
        shape) printf 'version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n[[light]]\ntype = "point"\nposition = [2, 2, 3]\n[[object]]\ntype = "try-shape"\n' >shape.toml
               quiet candela render shape.toml --defaults --plugin-dir "$2" -o "$3" ;;
        light) quiet candela render --set light.lamp.type=try-light --plugin-dir "$2" -o "$3" ;;
        *) quiet candela render "--$1" "try-$1" --plugin-dir "$2" -o "$3" ;;
    esac
}

number=0
for case in "${@:4}"; do
    IFS=, read -r compiler generator standard extensions kinds <<<"$case"
    number=$((number + 1))
    for kind in ${kinds//+/ }; do
        say "$kind by $compiler, $generator, C++$standard, extensions $extensions"
        project=$scratch/$number/try-$kind
        mkdir -p "$scratch/$number"
        quiet candela plugin new "$kind" "try-$kind" "$project"
        quiet "$cmake" -G "$generator" -S "$project" -B "$project/build" -DCMAKE_BUILD_TYPE=Release \
            -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_STANDARD="$standard" \
            -DCMAKE_CXX_EXTENSIONS="$extensions"
        quiet "$cmake" --build "$project/build"
        if grep -q warning "$scratch/log"; then cat "$scratch/log" >&2; fail "building $kind warns"; fi
        found=$(find "$project/build" \( -name '*.ddi' -o -name '*.pcm' -o -name '*.gcm' \) -print)
        [ -z "$found" ] || fail "modules were scanned or built: $found"
        quiet bash "$here/scalar_loops.sh" "$project/build/$kind-try-$kind.so"
        (cd "$project/build" && quiet "$(dirname "$cmake")/ctest" --output-on-failure)
        [ "$(grep -c ": $kind/try-$kind .*Passed" "$scratch/log")" -eq 2 ] || { cat "$scratch/log" >&2; fail "$kind has not two tests"; }
        render "$kind" "$project/build" "$project.png"
        [ -f "$kind.png" ] || cp "$project.png" "$kind.png"
        quiet candela diff "$kind.png" "$project.png" --tolerance 1
    done
done
say "all well"
