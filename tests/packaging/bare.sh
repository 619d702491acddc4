#!/usr/bin/env bash
# Tries the README's two commands on a bare Debian, in a folder made by mmdebstrap or debootstrap, without a terminal.
#   bare.sh SUITE                     bookworm, trixie, …: ./scripts/render.sh and then ./scripts/test.sh, as root
#   bare.sh --user SUITE              as an ordinary user who may use sudo
#   bare.sh [--user] SUITE COMMAND    that command in a clean clone instead, such as `./scripts/render.sh`
#   bare.sh --keep FOLDER …           makes the system in FOLDER, unless that exists, and leaves it there
# Needs root, and mmdebstrap or debootstrap. Tests the last commit, with the mirror that apt uses here.
# Prints the time of each command, and the picture's SHA-256; the exit code is that of the first command that fails.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)

say() { printf 'bare: %s\n' "$*" >&2; }
fail() { say "$*"; exit 2; }

user=root
keep=
while [ $# -gt 0 ]; do
    case $1 in
        --user) user=tester; shift ;;
        --keep) keep=${2:?--keep needs a folder}; shift 2 ;;
        -h|--help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
        -*) fail "unknown option '$1' (allowed: --user, --keep FOLDER)" ;;
        *) break ;;
    esac
done
[ $# -ge 1 ] || fail "which suite? (bare.sh [--user] [--keep FOLDER] SUITE [COMMAND])"
suite=$1
shift
[ $# -gt 0 ] && commands=("$*") || commands=(./scripts/render.sh ./scripts/test.sh)
[ "$(id -u)" -eq 0 ] || fail "only root can make and enter a separate system"
# A namespace of mounts and processes: whatever happens, nothing stays mounted or running.
if [ "${CANDELA_BARE_INSIDE-}" != yes ]; then
    exec env CANDELA_BARE_INSIDE=yes unshare --mount --pid --fork --kill-child "$0" \
        $([ "$user" = root ] || echo --user) ${keep:+--keep "$keep"} "$suite" "$@"
fi
mount --make-rprivate /

system=$keep
if [ -z "$system" ]; then
    system=$(mktemp -d "${TMPDIR:-/tmp}/candela-bare-XXXXXX")/$suite
    trap 'umount -R "$system/dev" "$system/proc" "$system/sys" 2>/dev/null; rm -rf --one-file-system "$(dirname "$system")"' EXIT
fi
if [ ! -d "$system" ]; then
    here=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
    mirror=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
        awk -v release="$here" '$1 == release && $2 == "main" { print $3; exit }')
    [ -n "$mirror" ] || fail "apt knows no mirror of '$here' main"
    say "making a bare $suite"
    extra=ca-certificates
    [ "$user" = root ] || extra=$extra,sudo
    if command -v mmdebstrap >/dev/null; then
        mmdebstrap --quiet --variant=minbase --include="$extra" "$suite" "$system" "$mirror"
    elif command -v debootstrap >/dev/null; then
        debootstrap --variant=minbase --include="$extra" "$suite" "$system" "$mirror" >/dev/null
    else
        fail "install mmdebstrap or debootstrap"
    fi
fi
if [ "$user" != root ] && ! grep -q "^$user:" "$system/etc/passwd"; then
    chroot "$system" useradd --create-home "$user"
    printf '%s ALL=(ALL) NOPASSWD: ALL\n' "$user" >"$system/etc/sudoers.d/$user"
fi
cp -L /etc/resolv.conf /etc/hosts "$system/etc/"

mount -t proc proc "$system/proc"
mount --rbind /dev "$system/dev"
mount --rbind /sys "$system/sys"
home=$(chroot "$system" sh -c "echo ~$user")
if [ ! -d "$system$home/candela" ]; then
    git -c safe.directory="$root" clone --quiet --no-hardlinks "$root" "$system$home/candela"
else
    git -c safe.directory='*' -C "$system$home/candela" fetch --quiet "$root" HEAD
    git -c safe.directory='*' -C "$system$home/candela" reset --quiet --hard FETCH_HEAD
fi
chroot "$system" chown -R "$user:" "$home/candela"
for command in "${commands[@]}"; do
    started=$EPOCHREALTIME
    status=0
    chroot "$system" setsid --wait env -i HOME="$home" USER="$user" LOGNAME="$user" LANG=C.UTF-8 \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        setpriv --reuid="$user" --regid="$user" --init-groups \
        bash -c "cd ~/candela && $command" </dev/null || status=$?
    say "$suite, $user: $command: exit code $status after $(((${EPOCHREALTIME/./} - ${started/./}) / 1000000)) s"
    [ "$status" -eq 0 ] || exit "$status"
done
for picture in "$system$home"/candela/*.png; do
    [ ! -f "$picture" ] || say "$(basename "$picture"): SHA-256 $(sha256sum <"$picture" | cut -d' ' -f1)"
done
