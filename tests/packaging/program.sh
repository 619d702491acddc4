#!/usr/bin/env bash
# Builds a program that imports the core's modules in its own CMake project against an installed Candela, and a plugin for it to
# use.
#   program.sh BUILD_DIR SCRATCH_DIR CMAKE CXX
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
here=$(cd "$(dirname "$0")" && pwd)

fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
quiet() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$*"; }; }

rm -rf "$scratch"
mkdir -p "$scratch/plugins"
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
for project in cel program; do
    cp -r "$here/$project" "$scratch/$project"
    quiet "$cmake" -G Ninja -S "$scratch/$project" -B "$scratch/$project/build" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$scratch/prefix"
    quiet "$cmake" --build "$scratch/$project/build"
done
cp "$scratch/cel/build"/reflection-cel.* "$scratch/plugins/"
quiet "$scratch/program/build/program" "$scratch/plugins"
grep -qF "it needs no tangents" "$scratch/log" || { cat "$scratch/log" >&2; fail "the program did not use the plugin"; }
