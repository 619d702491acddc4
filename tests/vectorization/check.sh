#!/usr/bin/env bash
# Reads what the compiler recorded of its loops, and fails where a batch loop was left scalar.
#   check.sh OBJECT_DIR…     directories with object files and, beside them, optimisation records (*.opt.yaml)
# Every version of every loop (candela::Multiversion<…>::baseline, avx2, avx512) that is in an object file must be in that
# file's record as vectorised, by at least 4, 8 and 16; and every directory must have such loops.
set -euo pipefail

loops=0
scalar=0
empty=0
for directory in "$@"; do
    before=$loops
    while IFS= read -r object; do
        record=${object%.o}.opt.yaml
        # Function and width of each vectorised loop.
        vectorized=
        if [ -f "$record" ]; then
            vectorized=$(awk '
                /^--- !/ { passed = ($2 == "!Passed"); name = ""; function_name = "" }
                /^Name:/ { name = $2 }
                /^Function:/ { function_name = $2 }
                /VectorizationFactor:/ { gsub(/\x27/, "", $NF); if (passed && name == "Vectorized") print function_name, $NF }
            ' "$record")
        fi
        while IFS= read -r symbol; do
            case $symbol in
                *E8baseline*) least=4 ;;
                *E4avx2*) least=8 ;;
                *E6avx512*) least=16 ;;
                *) continue ;;
            esac
            loops=$((loops + 1))
            width=$(awk -v wanted="$symbol" '$1 == wanted && $2 > best { best = $2 } END { print best + 0 }' <<<"$vectorized")
            if [ "$width" -lt "$least" ]; then
                scalar=$((scalar + 1))
                printf 'NOT VECTORIZED (width %s, expected %s): %s\n  in %s\n' "$width" "$least" "$(c++filt "$symbol")" "$object"
            fi
        done < <(nm --defined-only "$object" | awk '{ print $NF }' | grep '^_ZN7candela12MultiversionI' || true)
    done < <(find "$directory" -name '*.o' | sort)
    if [ "$loops" -eq "$before" ]; then
        empty=$((empty + 1))
        printf 'NO BATCH LOOPS in %s\n' "$directory"
    fi
done
printf '%d versions of batch loops, %d of them scalar\n' "$loops" "$scalar"
[ "$scalar" -eq 0 ] && [ "$empty" -eq 0 ] && [ "$loops" -gt 0 ]
