#!/usr/bin/env bash
# Installs every Debian or Ubuntu package that building, testing and running Candela needs.
#
#   scripts/setup.sh              everything, for developers and CI
#   scripts/setup.sh --build      only what building and rendering need
#   scripts/setup.sh --programs   everything, and the programs that scripts/bench.sh --programs compares with
#
# Works as root or with sudo. Does nothing if nothing is missing. On a release whose own CMake or Catch2 is too
# old, adds the release's backports from the mirror that apt already uses.
set -euo pipefail

readonly k_cmake_at_least=3.28
readonly k_catch2_at_least=3
readonly k_scikit_build_core_at_least=0.10

say() { printf 'setup: %s\n' "$*" >&2; }
fail() { say "$*"; exit 1; }

everything=yes
programs=no
case "${1-}" in
  '') ;;
  --build) everything=no ;;
  --programs) programs=yes ;;
  -h|--help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) say "unknown argument '$1' (allowed: --build, --programs)"; exit 2 ;;
esac

command -v apt-get >/dev/null || fail "this script supports only apt; CONTRIBUTING.md lists what to install elsewhere"

as_root=()
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes apt-get -qq -o DPkg::Lock::Timeout=300 "$@"; }

installed() { dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }
installed_version() { dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true; }
candidate() { LC_ALL=C apt-cache policy "$1" 2>/dev/null | sed -n 's/^  Candidate: //p' | grep -vx '(none)' || true; }
at_least() { [ -n "$1" ] && dpkg --compare-versions "$1" ge "$2"; }

packages=(
  ca-certificates git make
  libstdc++-12-dev ninja-build cmake cmake-data
  libeigen3-dev libtomlplusplus-dev libtbb-dev libembree-dev libfmt-dev libutfcpp-dev nlohmann-json3-dev zlib1g-dev libisal-dev libpng-dev
  libturbojpeg0-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev libstb-dev libopenimageio-dev esbuild libjs-codemirror
)
if [ "$everything" = yes ]; then
  packages+=(catch2 clang-format-19 glslang-tools python3 python3-jsonschema dpkg-dev file lintian
    g++ pkg-config libglfw3-dev libepoxy-dev libegl-dev libopengl-dev libegl1 libgl1-mesa-dri
    chromium chromium-sandbox chromium-driver firefox-esr xvfb python3-selenium python3-websocket valgrind
    zsh fish ffmpeg mkdocs mkdocs-material doxygen assimp-testmodels pybind11-dev python3-dev python3-numpy python3-build python3-venv povray)
fi

# Boost: Debian 12 has 1.81 in addition to its default 1.74; later releases offer no choice.
if installed libboost1.81-dev || [ -n "$(candidate libboost1.81-dev)" ]; then
  boost=(libboost1.81-dev libboost-program-options1.81-dev)
else
  boost=(libboost-dev libboost-program-options-dev)
fi

# With clang 22, compiling the core and clang-tidy take half the time of 19 or less; not every release has it.
compiler() {
  local version=19
  if installed clang-22 || [ -n "$(candidate clang-22)" ]; then version=22; fi
  echo clang-$version clang-tools-$version lld-$version
  if [ "$everything" = yes ]; then echo clang-tidy-$version libclang-rt-$version-dev; fi
}

# The oldest clang that builds plugins, for a test; not every release has it.
oldest_clang() {
  [ "$everything" = yes ] || return 0
  if installed clang-14 || [ -n "$(candidate clang-14)" ]; then echo clang-14; fi
}

# Makes the wheel of the Python module; not every release has it, or a new enough one.
wheel_backend() {
  [ "$everything" = yes ] || return 0
  if at_least "$(candidate python3-scikit-build-core)" "$k_scikit_build_core_at_least"; then echo python3-scikit-build-core; fi
}

# f3d and its display, and VTK's library, whose package has VTK's version in its name.
programs() {
  [ "$programs" = yes ] || return 0
  echo f3d xauth
  { LC_ALL=C apt-cache depends libvtk9-dev 2>/dev/null || true; } | sed -nE 's/^ *Depends: (libvtk9\.[0-9]+(t64)?)$/\1/p'
}

missing=()
find_missing() {
  local package
  missing=()
  for package in "${packages[@]}" "${boost[@]}" $(compiler) $(oldest_clang) $(wheel_backend) $(programs); do
    installed "$package" || missing+=("$package")
  done
  at_least "$(installed_version cmake)" "$k_cmake_at_least" || missing+=(cmake cmake-data)
  if [ "$everything" = yes ]; then
    at_least "$(installed_version catch2)" "$k_catch2_at_least" || missing+=(catch2)
  fi
}

find_missing
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    fail "run this as root, or install sudo; missing: $(printf '%s\n' "${missing[@]}" | sort -u | tr '\n' ' ')"
  as_root=(sudo)
fi
say "missing: $(printf '%s\n' "${missing[@]}" | sort -u | tr '\n' ' ')"
apt update
# A bare machine has had empty lists so far, so choices that depend on candidates are made again.
if [ -z "$(candidate libboost1.81-dev)" ]; then
  boost=(libboost-dev libboost-program-options-dev)
else
  boost=(libboost1.81-dev libboost-program-options1.81-dev)
fi
[ -n "$(candidate libstdc++-12-dev)" ] || packages=("${packages[@]/#libstdc++-12-dev/libstdc++-14-dev}")

# Adds the backports of this release from the mirror in use, and takes CMake and Catch2 from there.
codename=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME-}")
needs_backports() {
  ! at_least "$(candidate cmake)" "$k_cmake_at_least" ||
    { [ "$everything" = yes ] && ! at_least "$(candidate catch2)" "$k_catch2_at_least"; }
}
from_backports=()
if needs_backports; then
  backports="$codename-backports"
  if ! apt-get indextargets --format '$(RELEASE)' 'Created-By: Packages' | grep -qx "$backports"; then
    mirror=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
      awk -v release="$codename" '$1 == release && $2 == "main" { print $3; exit }')
    [ -n "$mirror" ] || fail "apt knows no mirror of '$codename' main, so its backports cannot be found"
    options=
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    [ -r "$keyring" ] && options="[signed-by=$keyring] "
    say "adding $backports from the mirror in use"
    printf 'deb %s%s %s main\n' "$options" "$mirror" "$backports" |
      "${as_root[@]}" tee "/etc/apt/sources.list.d/candela-backports.list" >/dev/null
    apt update
  fi
  from_backports=(cmake cmake-data)
  [ "$everything" = yes ] && from_backports+=(catch2)
fi

find_missing
for package in "${missing[@]}"; do
  # Packages that are only in the release's backports need others from there.
  case "$(candidate "$package")" in *~bpo*) from_backports+=("$package") ;; esac
done
if [ ${#from_backports[@]} -gt 0 ]; then
  apt install -y --no-install-recommends -t "$codename-backports" "${from_backports[@]}" >/dev/null
  find_missing
fi
if [ ${#missing[@]} -gt 0 ]; then
  say "installing ${#missing[@]} packages and their dependencies (a few minutes on a bare machine)"
  apt install -y --no-install-recommends "${missing[@]}" >/dev/null
fi

find_missing
[ ${#missing[@]} -eq 0 ] || fail "still missing after installation: ${missing[*]}"
say "done"
