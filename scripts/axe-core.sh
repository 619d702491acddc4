#!/usr/bin/env bash
# Brings axe-core, with which tests inspect how accessible the pages are, to build/axe-core/axe.min.js, by npm. Without npm, or where
# npm cannot fetch it, it says so: those tests are skipped then.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm axe-core 4.14.1 "tests of accessibility by it" \
    axe.min.js=29348999450cdf2849a8e70b7912fc2da85a849da39c0d0d5394f51d4a9ed95c
