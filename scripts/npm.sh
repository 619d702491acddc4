# Source this: fetches pinned packages with npm.

# bring_from_npm PACKAGE VERSION TESTS FILE=SHA256...: fetches files of a package to build/PACKAGE. If npm is missing or cannot
# fetch it, reports that TESTS will be skipped.
bring_from_npm() {
    local package=$1 version=$2 tests=$3 root folder draft each
    shift 3
    root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
    folder=$root/build/$package
    are_right() {
        local file
        for file in "${files[@]}"; do
            printf '%s  %s\n' "${file#*=}" "$1/${file%%=*}" | sha256sum --check --status 2>/dev/null || return 1
        done
    }
    local -a files=("$@")
    skip() { printf '%s: %s; %s will be skipped\n' "$package" "$*" "$tests" >&2; }

    if are_right "$folder"; then return 0; fi
    command -v npm >/dev/null || { skip "npm is missing"; return 0; }
    draft=$(mktemp -d)
    # shellcheck disable=SC2064  # the folder as it is now
    trap "rm -rf '$draft'" EXIT
    (cd "$draft" && npm pack --silent --fetch-retries=1 --fetch-timeout=30000 "$package@$version" >/dev/null) ||
        { skip "npm could not fetch version $version"; return 0; }
    tar -C "$draft" -xzf "$draft/$package-$version.tgz"
    are_right "$draft/package" || { printf '%s: npm fetched unexpected files\n' "$package" >&2; return 1; }
    mkdir -p "$folder"
    cp "$draft/package/LICENSE" "$folder/"
    for each in "${files[@]%%=*}"; do
        mkdir -p "$(dirname "$folder/$each")"
        cp "$draft/package/$each" "$folder/$each.draft"
        mv "$folder/$each.draft" "$folder/$each"
    done
}
