#!/usr/bin/env bash
# Builds the fuzzing harnesses and runs them, one after another, each from its committed corpus.
#   scripts/fuzz.sh                       each for 60 seconds
#   scripts/fuzz.sh SECONDS [HARNESS…]    scene, setting, manifest, mesh, mesh_file, material, gltf, photometry, request, answer,
#                                         kernel, model
#   scripts/fuzz.sh --merge [HARNESS…]    adds inputs that reach new code to the corpus, and removes those that no
#                                         longer adds anything
# A corpus is tests/robustness/fuzz/corpus/<harness>, inputs with descriptive names, and <harness>.tar.gz, inputs from fuzzing that reach code
# that these do not. New inputs and findings are written to build/fuzz/found/<harness>, never among the sources. The exit code tells
# whether there were findings.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

seconds=${1-60}
[ $# -eq 0 ] || shift
if [ "$seconds" != --merge ] && ! [[ $seconds =~ ^[1-9][0-9]*$ ]]; then
    sed -n '2,10s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
[ $# -gt 0 ] || set -- scene setting manifest mesh mesh_file material gltf photometry request answer kernel model

"$root/scripts/setup.sh"
cmake --preset fuzz -DCANDELA_TESTS=ON >/dev/null
cmake --build --preset fuzz

scratch=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")/candela-fuzz.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch
export ASAN_OPTIONS=${ASAN_OPTIONS-detect_stack_use_after_return=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS-print_stacktrace=1}

status=0
for harness in "$@"; do
    program=build/fuzz/tests/robustness/fuzz/candela_${harness}_fuzz
    corpus=tests/robustness/fuzz/corpus/$harness
    unpacked=build/fuzz/tests/robustness/fuzz/corpus/$harness
    found=build/fuzz/found/$harness
    [ -x "$program" ] || { echo "fuzz: unknown harness '$harness'" >&2; exit 2; }
    real=build/fuzz/tests/robustness/fuzz/corpus/${harness}_real  # of mesh_file
    seeds=("$corpus" "$unpacked")
    [ ! -d "$real" ] || seeds+=("$real")
    mkdir -p "$found/inputs" "$found/findings"
    options=(-rss_limit_mb=2048 -malloc_limit_mb=1024 -timeout=20 -artifact_prefix="$found/findings/" -print_final_stats=1)
    case $harness in
        scene) options+=(-max_len=4096 -dict=tests/robustness/fuzz/toml.dict) ;;
        setting) options+=(-max_len=512 -dict=tests/robustness/fuzz/toml.dict) ;;
        manifest) options+=(-max_len=4096 -dict=tests/robustness/fuzz/json.dict) ;;
        mesh) options+=(-max_len=1024) ;;
        mesh_file) options+=(-max_len=4096) ;;
        photometry) options+=(-max_len=2048 -dict=tests/robustness/fuzz/photometry.dict) ;;
        material) options+=(-max_len=2048 -dict=tests/robustness/fuzz/mtl.dict) ;;
        answer) options+=(-max_len=4096 -dict=tests/robustness/fuzz/kernel.dict) ;;
        kernel | model) options+=(-max_len=2048) ;;
        gltf) options+=(-max_len=8192 -dict=tests/robustness/fuzz/gltf.dict) ;;
    esac
    if [ "$seconds" = --merge ]; then
        # Named inputs are regression tests and stay. The others must add coverage.
        cp -r "$corpus" "$scratch/merged"
        "$program" "${options[@]}" -merge=1 "$scratch/merged" "${seeds[@]:1}" "$found/inputs" 2>&1 | tail -n 1
        # The same inputs always make the same archive.
        (cd "$scratch/merged" && find . -regextype egrep -regex '\./[0-9a-f]{40}' -printf '%P\0' | LC_ALL=C sort -z) |
            tar -C "$scratch/merged" --null --files-from=- --format=ustar --mtime=@0 --mode=0644 --owner=0 --group=0 --numeric-owner \
                -c | gzip -n -9 >"$corpus.tar.gz.new"
        mv "$corpus.tar.gz.new" "$corpus.tar.gz"
        rm -rf "$scratch/merged"
        continue
    fi
    printf '== %s, %s seconds\n' "$harness" "$seconds"
    if ! "$program" "${options[@]}" -max_total_time="$seconds" "$found/inputs" "${seeds[@]}" 2>"$found/log"; then
        status=1
        grep -aE 'finding:|SUMMARY|ERROR: |runtime error' "$found/log" || true
    fi
    tail -n 12 "$found/log"
    find "$found/findings" -type f -printf 'finding: %p\n'
done
exit "$status"
