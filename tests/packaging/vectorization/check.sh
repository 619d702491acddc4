#!/usr/bin/env bash
# Reads the compiler's records of loops, and fails if a batch loop was left scalar.
#   check.sh OBJECT[:OBJECT…]…     for each library, its object files, which have their optimisation records next to them (*.opt.yaml)
# Every version of every loop (candela::Multiversion<…>::baseline, avx2, avx512) in an object file must be vectorised in that
# file's record, by at least 4, 8 and 16; and every library must have such loops. A loop whose name ends in ByHand is vectorised by
# hand, and has no record.
set -euo pipefail

# A line "LOOP WIDTH LEAST SYMBOL OBJECT" for each version of a loop in object files, whose symbols come from `nm -A`.
widths() {
    awk '
        function read_record(record,    line, words, count, passed, name, loop, width) {
            split("", widest)
            while ((getline line < record) > 0) {
                count = split(line, words, " ")
                if (words[1] == "---") { passed = (words[2] == "!Passed"); name = ""; loop = "" }
                else if (line ~ /^Name:/) name = words[2]
                else if (line ~ /^Function:/) loop = words[2]
                else if (line ~ /VectorizationFactor:/ && passed && name == "Vectorized") {
                    width = words[count]
                    gsub(/\x27/, "", width)
                    if (width + 0 > widest[loop] + 0) widest[loop] = width
                }
            }
            close(record)
        }
        $NF ~ /^_ZN7candela12MultiversionI/ && $NF !~ /ByHand/ {
            least = $NF ~ /E8baseline/ ? 4 : $NF ~ /E4avx2/ ? 8 : $NF ~ /E6avx512/ ? 16 : 0
            if (!least) next
            object = $0
            sub(/\.o:.*/, ".o", object)
            if (object != last) { read_record(substr(object, 1, length(object) - 2) ".opt.yaml"); last = object }
            print "LOOP", widest[$NF] + 0, least, $NF, object
        }'
}

loops=0
scalar=0
empty=0
for library in "$@"; do
    before=$loops
    while read -r _ width least symbol object; do
        loops=$((loops + 1))
        [ "$width" -lt "$least" ] || continue
        scalar=$((scalar + 1))
        printf 'NOT VECTORIZED (width %s, expected %s): %s\n  in %s\n' "$width" "$least" "$(c++filt "$symbol")" "$object"
    done < <(printf '%s' "$library" | tr ':' '\0' | xargs -0 -r nm -A --defined-only | widths)
    if [ "$loops" -eq "$before" ]; then
        empty=$((empty + 1))
        printf 'NO BATCH LOOPS in %s\n' "${library//:/ }"
    fi
done
printf '%d versions of batch loops, %d of them scalar\n' "$loops" "$scalar"
[ "$scalar" -eq 0 ] && [ "$empty" -eq 0 ] && [ "$loops" -gt 0 ]
