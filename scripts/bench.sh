#!/usr/bin/env bash
# Measures Candela against OpenGL on this machine, in turns, and prints a table; build/bench/results.{md,json}.
#   scripts/bench.sh                              all scenes, 512 x 512 to 3840 x 2160, seven rounds (six minutes)
#   scripts/bench.sh --scenes A --sizes 512x512   fewer; --threads 1: both with one thread, not with all
#   scripts/bench.sh --sweep                      Candela alone: threads, instruction sets, models, lights, triangles (ten minutes)
#   scripts/bench.sh --growth                     how time grows with triangles, objects, lights and pixels; build/bench/growth.{md,json} (a minute)
#   scripts/bench.sh --programs                   against POV-Ray and VTK, whole processes; build/bench/programs.{md,json} (five minutes)
#   scripts/bench.sh --mesh-file                  against f3d on a PLY file of ten million triangles (two minutes)
#   scripts/bench.sh --view                       from a save and from a click to the screen, in a browser (two minutes)
#   scripts/bench.sh --reload                     from a saved mesh to the screen, against f3d, which is told to reload it (a minute)
#   scripts/bench.sh --third-party                plugins built against an installation, as by a third party, against the shipped ones
#   scripts/bench.sh --third-party --loops --compiler g++    the loops of reflection models, built by another compiler
#   scripts/bench.sh --animation                  200 frames in one process against 200 processes (half a minute)
#   scripts/bench.sh --textures                   frames with a texture of 4096 x 4096 against frames without (two minutes)
#   scripts/bench.sh --python                     models and pictures in Python against C++ (a minute)
#   scripts/bench.sh --instructions               records how many instructions the default scene takes, for a test to compare
# Use an otherwise idle machine.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

if [ "${1-}" = --programs ] || [ "${1-}" = --mesh-file ] || [ "${1-}" = --reload ]; then
    "$root/scripts/setup.sh" --programs
else
    "$root/scripts/setup.sh"
fi
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
if [ "${1-}" = --instructions ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec python3 -B "$root/tests/bench/instructions.py" "$root/build/release/bin/candela" "$root/tests/bench/instructions.json" --update
fi
if [ "${1-}" = --sweep ] || [ "${1-}" = --growth ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec python3 -B "$root/tests/bench/${1#--}.py" "$root/build/release" "$root/build/bench" "${@:2}"
fi
if [ "${1-}" = --mesh-file ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec python3 -B "$root/tests/bench/mesh_file.py" "$root/build/release" "$root/build/bench/mesh-file" "${@:2}"
fi
if [ "${1-}" = --view ] || [ "${1-}" = --reload ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec /usr/bin/python3 -B "$root/tests/bench/${1#--}.py" "$root/build/release" "${@:2}"
fi
if [ "${1-}" = --textures ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec python3 -B "$root/tests/bench/textures.py" "$root/build/release" "$root/build/bench/textures" "${@:2}"
fi
if [ "${1-}" = --python ]; then
    cmake --build --preset release --target candela_runtime candela_python_package candela_python_rival >/dev/null
    exec /usr/bin/python3 -B "$root/tests/bench/python.py" "$root/build/release" "${@:2}"
fi
if [ "${1-}" = --animation ]; then
    cmake --build --preset release --target candela_runtime >/dev/null
    exec python3 -B "$root/tests/bench/animation.py" "$root/build/release" "$root/build/bench/animation" "${@:2}"
fi
if [ "${1-}" = --third-party ]; then
    cmake --build --preset release --target all candela_kernel_loops >/dev/null
    exec python3 -B "$root/tests/bench/third_party.py" "$root/build/release" "$root/build/bench/third-party" "${@:2}"
fi
cmake --build --preset release --target candela_runtime candela_diff candela_dump_scene candela_empty_program \
    candela_opengl_rival >/dev/null
if [ "${1-}" = --programs ]; then
    mkdir -p "$root/build/bench"
    "$root/tests/bench/vtk.sh" "$root/build/bench"
    exec python3 -B "$root/tests/bench/programs.py" "$root/build/release" "$root/build/bench" "${@:2}"
fi
python3 -B "$root/tests/bench/bench.py" "$root/build/release" "$root/build/bench" "$@"
