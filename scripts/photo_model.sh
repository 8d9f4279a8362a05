#!/usr/bin/env bash
# Puts the files with which the studio's page finds poses in photos (npm's @mediapipe/pose, Apache-2.0) into a folder, where `choreo studio`
# looks for them: share/choreo/photo beside bin. Without npm or a registry the studio works without them.
#   scripts/photo_model.sh FOLDER
set -euo pipefail
files=(pose.js pose_landmark_full.tflite pose_solution_packed_assets.data pose_solution_packed_assets_loader.js
  pose_solution_simd_wasm_bin.data pose_solution_simd_wasm_bin.js pose_solution_simd_wasm_bin.wasm pose_web.binarypb)
folder=$1
missing=0
for file in "${files[@]}"; do [[ -f $folder/$file ]] || missing=1; done
[[ $missing == 0 ]] && exit 0
page=$(cd "$(dirname "$0")/../studio/page" && pwd)
if ! said=$(CHOREO_SKIP_CODE=1 "$page/../../tests/support/npm_ci.sh" "$page"); then
  echo "photo_model.sh: photos stay closed to the studio: ${said##*skipped: }" >&2
  exit 0
fi
mkdir -p "$folder"
for file in "${files[@]}"; do install -m 644 "$page/node_modules/@mediapipe/pose/$file" "$folder/$file"; done
