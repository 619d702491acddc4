#!/usr/bin/env bash
# Lists the versions of batch loops in a plugin that are scalar, or that call functions, which are not vectorised.
#   scalar_loops.sh PLUGIN.so      exit code 1: there are some, or there is no loop at all
set -euo pipefail
objdump -dC --no-show-raw-insn "$1" | awk '
    function judge() {
        if (version == "") return
        ++loops
        if (calls || !vectors) { print version (calls ? ", which calls: " : ", without vectors: ") name; ++scalar }
    }
    /^[0-9a-f]+ <.*>:$/ {
        judge()
        version = ""; calls = 0; vectors = 0; name = $0
        if (name ~ /candela::Multiversion</ && match(name, />::(baseline|avx2|avx512)\(/))
            version = substr(name, RSTART + 3, RLENGTH - 4)
    }
    # A loop with its own arrays checks its stack at the end; one copies the numbers that vary into columns.
    /[ \t]callq?[ \t]/ && !/__stack_chk_fail|memcpy@plt/ { ++calls }
    version == "baseline" && /(add|sub|mul)ps/ { ++vectors }
    version == "avx2" && /%ymm/ { ++vectors }
    version == "avx512" && /%zmm/ { ++vectors }
    END { judge(); print loops + 0 " versions of batch loops, " scalar + 0 " of them scalar"; exit !loops || scalar }'
