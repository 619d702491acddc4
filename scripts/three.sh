#!/usr/bin/env bash
# Fetches three.js, which the pages of the target three contain, to build/three, with npm. If npm is missing or cannot fetch it, reports
# that; the target then says what is missing, and its tests are skipped.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm three 0.170.0 "tests of its pages" \
    build/three.module.min.js=08fd7545d13d2c7fb65ab691530a802dafefd638596501854f267d0fb13c39e7
