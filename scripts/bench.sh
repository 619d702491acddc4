#!/usr/bin/env bash
# Measures Candela against OpenGL on this machine, in turns, and prints a table; build/bench/results.{md,json}.
#   scripts/bench.sh                              all scenes, 512 x 512 to 3840 x 2160, seven rounds (six minutes)
#   scripts/bench.sh --scenes A --sizes 512x512   fewer; --threads 1: both with one thread, not with all
#   scripts/bench.sh --sweep                      Candela alone: threads, instruction sets, models, lights, triangles (ten minutes)
#   scripts/bench.sh --growth                     how time grows with triangles, objects, lights and pixels; build/bench/growth.{md,json} (a minute)
#   scripts/bench.sh --programs                   against POV-Ray and VTK, whole processes; build/bench/programs.{md,json} (five minutes)
#   scripts/bench.sh --mesh-file                  against f3d on a PLY file of ten million triangles (two minutes)
#   scripts/bench.sh --view                       from a save and from a click to the screen, in a browser (two minutes)
#   scripts/bench.sh --third-party                plugins built against an installation, as by a third party, against the shipped ones
#   scripts/bench.sh --animation                  200 frames in one process against 200 processes (half a minute); --workers: frames of
#                                                 4K by two workers against one
#   scripts/bench.sh --textures                   frames with a texture of 4096 x 4096 against frames without (two minutes)
#   scripts/bench.sh --shadows                    frames with shadows against those without, rays against a bare loop over Embree (five minutes)
#   scripts/bench.sh --python                     models and pictures in Python against C++ (a minute)
#   scripts/bench.sh --instructions               records how many instructions the default scene takes, for a test to compare
# Use an otherwise idle machine.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

mode=opengl
if [[ ${1-} =~ ^--(sweep|growth|programs|mesh-file|view|third-party|animation|textures|shadows|python|instructions)$ ]]; then
    mode=${1#--}
    shift
fi
# A module of Debian's Python is built for it, and Selenium is installed for it.
python=python3
setup=()
targets=(candela_runtime)
out=("$root/build/bench/$mode")
script=${mode//-/_}
case $mode in
    opengl | programs) targets+=(candela_diff candela_dump_scene candela_empty_program candela_opengl_rival); out=("$root/build/bench") ;;&
    opengl) script=bench ;;
    programs | mesh-file) setup=(--programs) ;;
    sweep | growth) out=("$root/build/bench") ;;
    shadows) targets+=(candela_occlusion_rays); out=("$root/build/bench") ;;
    view) python=/usr/bin/python3; out=() ;;
    python) python=/usr/bin/python3; out=(); targets+=(candela_python_package candela_python_rival) ;;
    third-party) targets=(all) ;;
esac
"$root/scripts/setup.sh" "${setup[@]}"
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build --preset release --target "${targets[@]}" >/dev/null
if [ "$mode" = programs ]; then
    mkdir -p "$root/build/bench"
    "$root/tests/bench/vtk.sh" "$root/build/bench"
fi
build=$root/build/release
if [ "$mode" = instructions ]; then
    set -- --update
    build=$build/bin/candela
    out=("$root/tests/bench/instructions.json")
fi
exec "$python" -B "$root/tests/bench/$script.py" "$build" "${out[@]}" "$@"
