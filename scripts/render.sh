#!/usr/bin/env bash
# Sets up, builds and renders the default scene to candela.png. Arguments go to `candela render`:
#   scripts/render.sh                          the default scene
#   scripts/render.sh my-scene.toml -o my.png  another
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

"$root/scripts/setup.sh" --build
log=$root/build/render-build.log
mkdir -p "$root/build"
# Only what rendering needs; what a developer has configured stays as it is.
configure=()
if [ ! -f "$root/build/release/build.ninja" ]; then
    configure=(-DCANDELA_TESTS=OFF)
    echo "render: building, which takes a minute or two (log: $log)" >&2
fi
if ! { cmake -S "$root" --preset release "${configure[@]}" && cmake --build "$root/build/release" --target candela_runtime; } \
    >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "render: the build failed; all of it is in $log" >&2
    exit 1
fi
exec "$root/build/release/bin/candela" render "$@"
