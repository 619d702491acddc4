#!/usr/bin/env bash
# Checks a plugin build's optional diagnostics: the line of a kernel that keeps its loop scalar, and data races.
#   watched.sh BUILD_DIR SCRATCH_DIR CMAKE CXX
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
here=$(cd "$(dirname "$0")" && pwd)
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
expect() { grep -qF -- "$1" "$scratch/log" || { cat "$scratch/log" >&2; fail "'$1' is missing"; }; }

rm -rf "$scratch"
mkdir -p "$scratch"
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null

# make FOLDER OPTION...: builds the plugin in that folder; the output is in the log.
make() {
    "$cmake" -G Ninja -S "$1" -B "$1/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" "${@:2}" >"$scratch/log" 2>&1 &&
        "$cmake" --build "$1/build" >"$scratch/log" 2>&1
}

say "a kernel whose loop is vectorised is not mentioned"
cp -r "$here/cel" "$scratch/cel"
make "$scratch/cel" -DCMAKE_CXX_COMPILER="$cxx" || { cat "$scratch/log" >&2; fail "the plugin is not built"; }
! grep -qi "vectorized" "$scratch/log" || { cat "$scratch/log" >&2; fail "there is an unexpected warning"; }

say "for one that is not, the line is named, once, and no header of Candela"
cp -r "$here/cel" "$scratch/slow"
sed -i 's|^    float level = .*|    float level = 1.0f;\n    for (int i = 0; i < 100; ++i) {\n        if (level <= dot(s.normal, to_light)) {\n            break;\n        }\n        level = level - 1.0f / bands;\n    }|' "$scratch/slow/cel.kernel"
line=$(grep -n "for (int" "$scratch/slow/cel.kernel" | cut -d: -f1)
make "$scratch/slow" -DCMAKE_CXX_COMPILER="$cxx" || { cat "$scratch/log" >&2; fail "a slow plugin is still a plugin"; }
expect "$scratch/slow/cel.kernel:$line:5: warning: this keeps the loop over points from being vectorized, so that the plugin is several times slower: "
[ "$(grep -c vectorized "$scratch/log")" -eq 1 ] || { cat "$scratch/log" >&2; fail "it is reported more than once"; }
! grep -q "_plugin.h\|multiversion" "$scratch/log" || { cat "$scratch/log" >&2; fail "headers are blamed"; }

say "it is an error where warnings are errors"
rm -r "$scratch/slow/build"
! make "$scratch/slow" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON || fail "the plugin was built"
expect "$scratch/slow/cel.kernel:$line:5: error: this keeps the loop"
[ ! -e "$scratch/slow/build/reflection-cel.json" ] || fail "it has a manifest"

say "with CANDELA_SANITIZE=thread, ThreadSanitizer watches a second library; the plugin itself is unchanged"
cp -r "$here/cel" "$scratch/watched"
sed -i 's/^find_package/enable_testing()\nfind_package/' "$scratch/watched/CMakeLists.txt"
for compiler in "$cxx" g++; do
    rm -rf "$scratch/watched/build"
    make "$scratch/watched" -DCMAKE_CXX_COMPILER="$compiler" -DCANDELA_SANITIZE=thread || { cat "$scratch/log" >&2; fail "it is not built by $compiler"; }
    "$(dirname "$cmake")/ctest" --test-dir "$scratch/watched/build" --output-on-failure >"$scratch/log" 2>&1 ||
        { cat "$scratch/log" >&2; fail "it does not pass with $compiler"; }
    expect "reflection/cel has no data races"
    expect "reflection/cel conforms"
    ! nm -D "$scratch/watched/build/reflection-cel.so" | grep -q __tsan || fail "the plugin itself is instrumented"
done
say "if a compiler lacks ThreadSanitizer, that is reported, and the plugin is built"
printf '#!/bin/sh\nfor word; do [ "$word" != -fsanitize=thread ] || exit 1; done\nexec %s "$@"\n' "$cxx" >"$scratch/without"
chmod +x "$scratch/without"
rm -rf "$scratch/watched/build"
"$cmake" -G Ninja -S "$scratch/watched" -B "$scratch/watched/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" \
    -DCMAKE_CXX_COMPILER="$scratch/without" -DCANDELA_SANITIZE=thread >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "it is refused"; }
expect "data races are"
"$cmake" --build "$scratch/watched/build" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "it is not built"; }
rm -rf "$scratch/watched/build"

say "a kernel function that writes to a shared variable is found, with its line"
# A kernel file alone cannot: the kernel language has no such variables.
cp "$scratch/cel/build/reflection-cel.cpp" "$scratch/watched/cel.cpp"
sed -i "s|$scratch/cel/cel.kernel|cel.kernel|" "$scratch/watched/cel.cpp"
sed -i 's|KERNEL cel.kernel|KERNEL cel.kernel SOURCES cel.cpp|' "$scratch/watched/CMakeLists.txt"
sed -i 's|^    float bands = .*|    static int cel_calls = 0;\n    cel_calls += 1;\n&|' "$scratch/watched/cel.kernel"
line=$(grep -n "+= 1" "$scratch/watched/cel.kernel" | cut -d: -f1)
make "$scratch/watched" -DCMAKE_CXX_COMPILER="$cxx" -DCANDELA_SANITIZE=thread || { cat "$scratch/log" >&2; fail "it is not built"; }
! "$(dirname "$cmake")/ctest" --test-dir "$scratch/watched/build" -R "data races" --output-on-failure >"$scratch/log" 2>&1 ||
    { cat "$scratch/log" >&2; fail "the race is not found"; }
expect "data race"
expect "cel.kernel:$line"
say "all well"
