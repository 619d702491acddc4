#!/usr/bin/env bash
# Checks the sentence that find_package(candela) prints, before CMake's own errors, where plugins or modules cannot be built.
#   refusals.sh BUILD_DIR SCRATCH_DIR CMAKE CXX
set -euo pipefail
build=$1 scratch=$2 cmake=$3 cxx=$4
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }

command -v g++ >/dev/null && command -v make >/dev/null || { echo "SKIPPED: g++ or make is not installed"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
unset CMAKE_GENERATOR

# refused NAME GENERATOR COMPILER BEFORE AFTER WORDS: a project with BEFORE and AFTER around find_package() gets the
# message WORDS. Projects with the same generator and compiler share a build folder, so that CMake examines the compiler once.
refused() {
    local project="$scratch/$2, ${3##*/}"
    mkdir -p "$project"
    printf 'cmake_minimum_required(VERSION 3.25)\n%s\nfind_package(candela REQUIRED)\n%s\n' "$4" "$5" >"$project/CMakeLists.txt"
    echo 'int main() {}' >"$project/main.cpp"
    if "$cmake" -G "$2" -S "$project" -B "$project/build" -DCMAKE_CXX_COMPILER="$3" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
        >"$scratch/log" 2>&1; then fail "$1: it was configured"; fi
    # CMake breaks lines anywhere.
    tr -s ' \n' ' ' <"$scratch/log" | grep -qF -- "$6" || { cat "$scratch/log" >&2; fail "$1: not '$6'"; }
    printf '== %s: %s\n' "$1" "$6"
}

project='project(x LANGUAGES CXX)'
program='add_executable(x main.cpp)
target_link_libraries(x PRIVATE candela::core)'
refused no-cxx Ninja "$cxx" 'project(x LANGUAGES NONE)' '' \
    "Candela's plugins are written in C++, which this project has not enabled: project(… LANGUAGES CXX) must come before find_package(candela)"
refused old-cmake Ninja "$cxx" "$project
set(CMAKE_VERSION 3.24.3)" '' "Candela's plugins need CMake 3.25 or newer; this is 3.24.3"
refused old-gcc Ninja g++ "$project
set(CMAKE_CXX_COMPILER_VERSION 11.4.0)" '' "Candela's plugins need g++ 12 or clang 14, or newer;"
refused old-clang Ninja "$cxx" "$project
set(CMAKE_CXX_COMPILER_VERSION 13.0.1)" '' "is Clang 13.0.1 (choose another with -DCMAKE_CXX_COMPILER=…)"
refused other-compiler Ninja "$cxx" "$project
set(CMAKE_CXX_COMPILER_ID MSVC)" '' "Candela's plugins need g++ 12 or clang 14, or newer;"
refused modules-by-make 'Unix Makefiles' "$cxx" "$project" "$program" \
    "candela::core, whose C++ modules need the generator Ninja, but this is Unix Makefiles"
refused modules-by-gcc Ninja g++ "$project" "$program" "candela::core, whose C++ modules need clang 19 or newer, but this is GNU"
refused modules-by-old-cmake Ninja "$cxx" "$project
set(CMAKE_VERSION 3.27.1)" "$program" "candela::core, whose C++ modules need CMake 3.28 or newer, but this is 3.27.1"
refused modules-without-scanner Ninja "$cxx" "$project
set(CMAKE_CXX_COMPILER_CLANG_SCAN_DEPS CMAKE_CXX_COMPILER_CLANG_SCAN_DEPS-NOTFOUND)" "$program" \
    "candela::core, whose C++ modules need clang-scan-deps, which is not next to the compiler (package clang-tools-$("$cxx" -dumpversion | cut -d. -f1))"

# A project's own older standard is raised for the plugin.
mkdir "$scratch/old-standard"
cp "$(dirname "$0")"/cel/cel.* "$scratch/old-standard"
sed 's/^project.*/&\nset(CMAKE_CXX_STANDARD 17)\nset(CMAKE_CXX_STANDARD_REQUIRED ON)/' "$(dirname "$0")/cel/CMakeLists.txt" \
    >"$scratch/old-standard/CMakeLists.txt"
"$cmake" -G 'Unix Makefiles' -S "$scratch/old-standard" -B "$scratch/old-standard/build" -DCMAKE_CXX_COMPILER=g++ \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "C++17 was not raised"; }
"$cmake" --build "$scratch/old-standard/build" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "C++17 was not raised"; }
echo "== all well"
