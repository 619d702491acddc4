#!/usr/bin/env bash
# Sets up, builds and renders the default scene to candela.png. Arguments go to `candela render`:
#   scripts/render.sh                          the default scene
#   scripts/render.sh my-scene.toml -o my.png  another
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

"$root/scripts/setup.sh" --build
log=$root/build/render-build.log
mkdir -p "$root/build"
# Passes ninja's lines to the log, and shows the progress on a terminal.
follow_build() {
    local line
    while IFS= read -r line; do
        printf '%s\n' "$line"
        if [ -t 2 ] && [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
            printf '\rrender: building, %3d %%' $((100 * BASH_REMATCH[1] / BASH_REMATCH[2])) >&2
        fi
    done
    if [ -t 2 ]; then printf '\r\033[K' >&2; fi
}
# Builds only what most pictures need, without targets, most verbs, and models in place of scenes; a developer's configuration stays as
# it is.
configure=()
if [ ! -f "$root/build/release/build.ninja" ]; then
    configure=(-DCANDELA_TESTS=OFF)
    echo "render: building, which takes two to three minutes on two cores (log: $log)" >&2
fi
# A program built earlier must not be left behind the core that it is linked to.
target=candela_rendering
programs=$root/build/release/lib/candela
{ [ ! -e "$programs/candela-verbs" ] && [ ! -e "$programs/candela-diff" ]; } || target=candela_runtime
if ! { cmake -S "$root" --preset release "${configure[@]}" && cmake --build "$root/build/release" --target "$target"; } 2>&1 |
    follow_build >"$log"; then
    tail -n 30 "$log" >&2
    echo "render: the build failed; see $log" >&2
    exit 1
fi
exec "$root/build/release/bin/candela" render "$@"
