#!/usr/bin/env bash
# Draws docs/images/side_by_side.jpg: ten frames of a recording, and of a dance through its poses every 2 s.
#   scripts/side_by_side.sh BIN_DIRECTORY RECORDING.bvh FIRST_SECOND OUT.jpg
# The one on the page: .../dancedb/bvh/Sophie_Excited-BVH.bvh 10
set -euo pipefail
(($# == 4)) || { echo "side_by_side.sh: BIN_DIRECTORY, RECORDING.bvh, FIRST_SECOND and OUT.jpg are wanted" >&2; exit 2; }
choreo=$1/choreo
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
seconds=6

# Six seconds of the recording as text: a frame per line, after the line of their distance.
rate=$(awk '/^Frame Time:/ { printf "%.0f", 1 / $3; exit }' "$2")
awk -v first=$((rate * $3)) -v count=$((rate * seconds + 1)) '
  /^Frames:/ { print "Frames: " count; next }
  !moving { print }
  moving && line >= first && line < first + count { print }
  moving { ++line }
  /^Frame Time:/ { moving = 1 }' "$2" >"$scratch/real.bvh"
keys=()
for ((second = 0; second <= seconds; second += 2)); do keys+=(-k "$scratch/real.bvh@$second=$second"); done
"$choreo" dance "${keys[@]}" --allow-bends --seed 1 --out "$scratch/danced.npz" --report "$scratch/danced.json" >/dev/null
"$choreo" render "$scratch/real.bvh" --frames 10 --columns 10 --title "A dancer whom the model has never seen" --out "$scratch/real.png"
"$choreo" render "$scratch/danced.npz" --report "$scratch/danced.json" --frames 10 --columns 10 \
  --title "Danced through four of her poses, which are framed" --out "$scratch/danced.png"
ffmpeg -v error -y -i "$scratch/real.png" -i "$scratch/danced.png" -filter_complex "vstack,scale=1400:-1" -q:v 6 -frames:v 1 "$4"
