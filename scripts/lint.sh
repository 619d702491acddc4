#!/usr/bin/env bash
# Checks the form of all sources: clang-format, and clang-tidy with the release build (made first if need be).
#   scripts/lint.sh            everything
#   scripts/lint.sh --format   only clang-format, which takes a second
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
git ls-files -z '*.cpp' '*.cppm' '*.h' | xargs -0 clang-format-19 --dry-run --Werror
[ "${1-}" != --format ] || exit 0

cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build --preset release >/dev/null
git ls-files -z 'core/*.cpp' 'sdk/*.cpp' 'apps/*.cpp' 'plugins/*.cpp' | grep -zv -e '_test\.cpp$' -e '^sdk/templates/' -e '^plugins/target/.*/templates/' |
    xargs -0 -n 1 -P "$(nproc)" sh -c 'clang-tidy-19 -p build/release --quiet "$1" 2>/dev/null || { echo "clang-tidy: $1" >&2; exit 1; }' tidy
echo "lint: clean"
