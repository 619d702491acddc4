#!/usr/bin/env bash
# Fetches axe-core, with which tests check the pages' accessibility, to build/axe-core/axe.min.js, with npm. If npm is missing
# or cannot fetch it, reports that; those tests are then skipped.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm axe-core 4.14.1 "accessibility tests" \
    axe.min.js=29348999450cdf2849a8e70b7912fc2da85a849da39c0d0d5394f51d4a9ed95c
