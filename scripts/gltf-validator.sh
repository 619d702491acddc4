#!/usr/bin/env bash
# Fetches Khronos' glTF-Validator, with which a test checks exported GLB files, to build/gltf-validator, with npm. If npm is
# missing or cannot fetch it, reports that; the test is then skipped.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm gltf-validator 2.0.0-dev.3.10 "the test of GLB files" \
    index.js=78deff9ea85743e86461c2d14fae76e7fc3ca0432e652f62948066b55fa16f0d \
    gltf_validator.dart.js=b73a7b2d455ac217567725138b46d826a13d7d1bb0c88c15f7c571bfb349298c
