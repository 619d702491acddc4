#!/usr/bin/env bash
# Compiles every kernel, after the prelude, as GLSL 3.30 and GLSL ES 3.00: a kernel is in the common subset of C++ and GLSL, or
# it cannot be exported.
#   check.sh PRELUDE KERNEL…     table.glsl is in the prelude's folder
set -euo pipefail
prelude=$1
shift

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compiled=0
failed=0
for kernel in "$@"; do
    for version in '330 core' '300 es'; do
        shader=$scratch/shader.frag
        {
            printf '#version %s\n' "$version"
            [ "$version" = '330 core' ] || printf 'precision highp float;\nprecision highp int;\n'
            printf '#define KERNEL\nout vec4 color;\n'
            cat "${prelude%/*}/table.glsl" "$prelude" "$kernel"
            printf 'void main() { color = vec4(1.0); }\n'
        } >"$shader"
        if glslangValidator "$shader" >"$scratch/log" 2>&1; then
            compiled=$((compiled + 1))
        else
            failed=$((failed + 1))
            printf 'NOT GLSL %s: %s\n' "$version" "$kernel"
            cat "$scratch/log"
        fi
    done
done
printf '%d compiled, %d failed\n' "$compiled" "$failed"
[ "$failed" -eq 0 ] && [ "$compiled" -gt 0 ]
