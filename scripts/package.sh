#!/usr/bin/env bash
# Sets up, builds, and makes the Debian packages candela, candela-openimageio, candela-dev and python3-candela, and the wheel of
# the Python module, in build/packages.
#   scripts/package.sh             then, as root: apt-get install ./build/packages/*.deb
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
# With tests, because the conformance kit is part of candela-dev.
cmake --preset release -DCANDELA_TESTS=ON >/dev/null
cmake --build build/release --target candela_packaged
cpack --config build/release/CPackConfig.cmake -B build/packages
rm -rf build/packages/_CPack_Packages
if /usr/bin/python3 -c 'import scikit_build_core' 2>/dev/null; then
  /usr/bin/python3 -m build --wheel --no-isolation --outdir build/packages scripts/packaging/wheel
else
  echo "package: no wheel, because python3-scikit-build-core is not installed (scripts/setup.sh does that if the release's is new enough)" >&2
fi
