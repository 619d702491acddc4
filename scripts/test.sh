#!/usr/bin/env bash
# Sets up, builds and runs all tests.
#   scripts/test.sh            the release build, which users run
#   scripts/test.sh asan …     other presets: dev, asan, ubsan, tsan
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
"$root/scripts/axe-core.sh"
"$root/scripts/gltf-validator.sh"
"$root/scripts/three.sh"
[ $# -gt 0 ] || set -- release
for preset in "$@"; do
    printf '== %s\n' "$preset"
    cmake --preset "$preset" -DCANDELA_TESTS=ON >/dev/null
    cmake --build --preset "$preset"
    # More jobs than cores: some tests wait for a browser or for time to pass.
    ctest --preset "$preset" --parallel $(($(nproc) + 2))
done
