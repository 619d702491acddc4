#!/usr/bin/env bash
# Sets up, builds, and makes the Debian packages candela, candela-openimageio, candela-dev and python3-candela in build/packages.
#   scripts/package.sh             then, as root: apt-get install ./build/packages/*.deb
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
# With tests, because the conformance kit is a part of candela-dev.
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build build/release --target candela_packaged
cpack --config build/release/CPackConfig.cmake -B build/packages
rm -rf build/packages/_CPack_Packages
