#!/usr/bin/env bash
# Brings Khronos' glTF-Validator, with which a test inspects the GLB files that are written, to build/gltf-validator, by npm. Without npm,
# or where npm cannot fetch it, it says so: that test is skipped then.
set -euo pipefail
source "$(dirname "$0")/npm.sh"

bring_from_npm gltf-validator 2.0.0-dev.3.10 "the test of GLB files by it" \
    index.js=78deff9ea85743e86461c2d14fae76e7fc3ca0432e652f62948066b55fa16f0d \
    gltf_validator.dart.js=b73a7b2d455ac217567725138b46d826a13d7d1bb0c88c15f7c571bfb349298c
