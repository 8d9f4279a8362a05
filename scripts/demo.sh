#!/usr/bin/env bash
# Dances 24 seconds of a real song through the key poses of examples/demo.json, and shows the result.
#   scripts/demo.sh BIN_DIRECTORY OUT_DIRECTORY
set -euo pipefail
choreo=$1/choreo
out=$2
examples=$(dirname "$0")/../examples
song="/usr/share/games/fretsonfire/data/songs/sectoid/Escape from chaosland/song.ogg"
mkdir -p "$out"

# Without --server choreo starts the choreod beside it, and stops it afterwards. Fails if a key pose is missed by more than 1 mm.
"$choreo" dance "$song" --seconds 24 --seed 1 --keyframes "$examples/demo.json" --out "$out/dance.npz" --report "$out/report.json"
"$choreo" convert "$out/dance.npz" "$out/dance.bvh"
"$choreo" convert "$out/dance.npz" "$out/dance.glb"
"$choreo" render "$out/dance.npz" --report "$out/report.json" --out "$out/sheet.png" \
  --title "24 s of \"Escape from chaosland\"; key poses are framed"
"$choreo" render "$out/dance.npz" --report "$out/report.json" --video "$out/dance.mp4" --song "$song" --size 640x360

# The same song, led along a path, with a higher velocity factor for the left arm.
"$choreo" dance "$song" --seconds 10 --path "$examples/path.json" --velocity left_arm=1.5 \
  --out "$out/controlled.npz" --report "$out/controlled.json"
"$choreo" render "$out/controlled.npz" --report "$out/controlled.json" --out "$out/controlled.png" \
  --title "10 s along a path, the left arm 1.5 times as fast"

keys=$(($(grep -c '"id"' "$out/report.json") - $(grep -c '"holds"' "$out/report.json")))  # poses that are held count once
if [[ $keys -lt 4 ]]; then
  echo "demo.sh: only $keys key poses were danced through, at least 4 are wanted" >&2
  exit 1
fi
echo
echo "A dance through $keys key poses:"
for file in dance.mp4 dance.npz dance.glb dance.bvh sheet.png report.json controlled.npz controlled.png; do
  printf '  %-11s %8d bytes  %s\n' "$file" "$(stat -c %s "$out/$file")" "$(realpath "$out/$file")"
done
