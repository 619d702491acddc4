#!/usr/bin/env bash
# Runs a compiler through ccache. clang-toolchain.cmake makes this CMake's compiler launcher if ccache is installed.
#   ccache.sh COMPILER ARGUMENT...
# ccache (4.7) does not know that an object depends on the module interfaces its source imports, and would return one that was
# compiled against older interfaces. So this script passes them as extra files to hash. Compiled interfaces and optimisation
# records, which ccache would not restore, are never cached.
set -eu

command -v ccache >/dev/null || exec "$@"  # it was installed when the build was configured
imported=
for argument in "$@"; do
    case $argument in
        -fsave-optimization-record*) exec "$@" ;;
        @*)
            while read -r option || [ -n "$option" ]; do
                case $option in
                    -fmodule-file=*=*:*) exec "$@" ;;
                    -fmodule-file=*=*)
                        option=${option#*=}
                        imported+=${imported:+:}${option#*=}
                        ;;
                    *) exec "$@" ;;
                esac
            done <"${argument#@}"
            ;;
    esac
done
[ -z "$imported" ] || export CCACHE_EXTRAFILES=$imported${CCACHE_EXTRAFILES:+:$CCACHE_EXTRAFILES}
exec ccache "$@"
