#!/usr/bin/env bash
# Brings three.js, which the pages of the target three contain, to build/three, by npm. Without npm, or where npm cannot fetch it, it says
# so: that target then says what it lacks, and its tests are skipped.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm three 0.170.0 "tests of pages with it" \
    build/three.module.min.js=08fd7545d13d2c7fb65ab691530a802dafefd638596501854f267d0fb13c39e7
