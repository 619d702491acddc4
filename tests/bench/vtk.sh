#!/usr/bin/env bash
# vtk.sh OUT: OUT/vtk_rival from vtk_rival.cpp.
#
# libvtk9-dev conflicts with the Boost that Candela is built with: it needs libgdal-dev, which needs libkml-dev, which needs
# another Boost's headers. So its headers are unpacked in OUT, and the library comes from its own package.
set -euo pipefail
out=${1:?vtk.sh OUT}
here=$(cd "$(dirname "$0")" && pwd)
say() { printf 'vtk: %s\n' "$*" >&2; }

package=$({ dpkg-query -W -f '${db:Status-Status} ${Package}\n' 'libvtk9.*' 2>/dev/null || true; } |
    sed -nE 's/^installed (libvtk9\.[0-9]+(t64)?)$/\1/p' | tail -n 1)
[ -n "$package" ] || { say "VTK's library is missing (apt-get update, then scripts/setup.sh --programs)"; exit 1; }
version=$(dpkg-query -W -f '${Version}' "$package")
headers=$out/vtk-$version
if [ ! -d "$headers" ]; then
    rm -rf "$out/vtk-new"
    mkdir -p "$out/vtk-new"
    (cd "$out/vtk-new" && apt-get -qq -o APT::Sandbox::User=root download "libvtk9-dev=$version") ||
        { say "no headers of VTK $version to download"; exit 1; }
    dpkg-deb -x "$out/vtk-new"/libvtk9-dev_*.deb "$out/vtk-new"
    mv "$out/vtk-new" "$headers"
fi
mapfile -t libraries < <(dpkg -L "$package" |
    grep -E '/libvtk(CommonCore|CommonDataModel|CommonExecutionModel|IOImage|RenderingCore|RenderingOpenGL2)-[0-9.]+\.so\.[0-9.]+$')
g++ -std=c++17 -O2 -rdynamic -isystem "$headers"/usr/include/vtk-9* "$here/vtk_rival.cpp" -o "$out/vtk_rival" -lEGL "${libraries[@]}"
