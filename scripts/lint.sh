#!/usr/bin/env bash
# Checks the form of the sources: clang-format and the prose of all of them, clang-tidy for those that a change may have affected.
# Makes the release build first.
#   scripts/lint.sh              files that differ from upstream, committed or not, and those that include or import them
#   scripts/lint.sh --since REV [--minutes N]  like that, against REV, for at most N minutes
#   scripts/lint.sh --all        everything (half an hour with two cores)
#   scripts/lint.sh --format     only clang-format and the prose, which takes seconds
#   scripts/lint.sh --commits REV   only the subjects of the commits since REV
# If nothing differs from upstream, as in a fresh clone, everything is checked, unless the environment variable
# CANDELA_LINT_SINCE names a commit to compare with.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

usage() { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
commit() { git rev-parse --verify --quiet "$1^{commit}" 2>/dev/null; }

# The commit to compare with, or nothing to check everything.
compared_with() {
    local upstream base
    if [ -n "${CANDELA_LINT_SINCE-}" ]; then
        commit "$CANDELA_LINT_SINCE" || { echo "lint: CANDELA_LINT_SINCE is not a commit: $CANDELA_LINT_SINCE" >&2; return 2; }
        return
    fi
    for upstream in '@{upstream}' origin/HEAD origin/main; do
        base=$(git merge-base HEAD "$(commit "$upstream" || true)" 2>/dev/null) || continue
        if [ "$base" != "$(commit HEAD)" ] || ! git diff --quiet HEAD; then
            echo "$base"
            return
        fi
    done
}

scope=changed
limit=()
case "${1-}" in
    '') ;;
    --all | --format) scope=${1#--}; [ $# -eq 1 ] || usage ;;
    --commits) [ $# -eq 2 ] || usage; exec python3 -B "$root/scripts/prose.py" --commits "$2" ;;
    --since)
        [ $# -eq 2 ] || { [ $# -eq 4 ] && [ "$3" = --minutes ] && limit=("$3" "$4"); } || usage
        CANDELA_LINT_SINCE=$2
        ;;
    *) usage ;;
esac

"$root/scripts/setup.sh"
git ls-files --cached --others --exclude-standard -z '*.cpp' '*.cppm' '*.h' | xargs -0 clang-format-19 --dry-run --Werror
python3 -B "$root/scripts/prose.py"
[ "$scope" != format ] || exit 0

since=
[ "$scope" = all ] || since=$(compared_with)
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build --preset release >/dev/null
if [ -n "$since" ]; then
    echo "lint: changes since $(git log -1 --format='%h (%s)' "$since")"
    python3 -B "$root/scripts/tidy.py" build/release build/tidy --since "$since" "${limit[@]}"
else
    python3 -B "$root/scripts/tidy.py" build/release build/tidy --all
fi
echo "lint: clean"
