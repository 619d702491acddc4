#!/usr/bin/env bash
# Sets up, builds, and makes the documentation's site: build/site/html/index.html.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

"$root/scripts/setup.sh"
cmake --preset release >/dev/null
cmake --build build/release --target candela_runtime
exec python3 -B docs/site/site.py build/release/bin/candela build/site
