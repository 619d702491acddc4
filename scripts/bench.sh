#!/usr/bin/env bash
# Measures Candela against OpenGL on this machine, in turns, and prints a table; build/bench/results.{md,json}.
#   scripts/bench.sh                              all scenes, 512 x 512 and 1920 x 1080, seven rounds (some ten minutes)
#   scripts/bench.sh --scenes A --sizes 512x512   less
# On a machine that does nothing else.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build --preset release --target candela_runtime candela_diff candela_dump_scene candela_opengl_rival >/dev/null
python3 -B "$root/tests/bench/bench.py" "$root/build/release" "$root/build/bench" "$@"
