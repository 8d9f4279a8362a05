#!/usr/bin/env bash
# Draws what controls change (paper C, Figures 5 to 10): root paths and heights, velocity factors and lengths between the same two keys, which are framed,
# and beside the pictures the requested paths and speeds, dashed.
#   scripts/gallery_controls.sh BIN_DIRECTORY OUT.webp [MODEL]
set -euo pipefail
(($# >= 2)) || { echo "gallery_controls.sh: BIN_DIRECTORY and OUT.webp are wanted" >&2; exit 2; }
choreo=$1/choreo
out=$2
model=${3:-paper-c}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

dance() {  # dance NAME FRAMES OPTION...: from a wide pose to a strong one 1.2 m ahead
  local name=$1 end
  end=$(awk -v n="$2" 'BEGIN { printf "%.6f", n / 30 }')
  cat >"$scratch/keys.json" <<JSON
{"keyframes": [{"id": "from", "time": 0, "pose": "groove", "place": [0, 0]}, {"id": "to", "time": $end, "pose": "muscles", "place": [0, 1.2]}]}
JSON
  "$choreo" dance --model "$model" --keyframes "$scratch/keys.json" "${@:3}" --out "$scratch/$name.npz" --report "$scratch/$name.json" >/dev/null
}
rows=()
row() {  # row NAME TITLE
  "$choreo" render "$scratch/$1.npz" --report "$scratch/$1.json" --frames 10 --columns 10 --title "$2" --out "$scratch/$1.png"
  ffmpeg -v error -y -i "$scratch/$1.png" -vf scale=900:-1 "$scratch/row$1.png"
  rows+=(-i "$scratch/row$1.png")
}
pair() {  # pair NAME: two plots side by side
  ffmpeg -v error -y -i "$scratch/a.png" -i "$scratch/b.png" -filter_complex "hstack,scale=900:-1" "$scratch/$1.png"
  rows+=(-i "$scratch/$1.png")
}

# Paths of 4 s that bow to either side, and a curved one.
path() {  # path NAME X1 Z1 X2 Z2
  echo "{\"points\": [{\"time\": 0, \"x\": 0, \"z\": 0}, {\"time\": 1.3, \"x\": $2, \"z\": $3}, {\"time\": 2.7, \"x\": $4, \"z\": $5}," \
    "{\"time\": 4, \"x\": 0, \"z\": 1.2}]}" >"$scratch/$1.path"
  dance "$1" 120 --path "$scratch/$1.path"
}
path left 0.6 0.3 0.6 0.9
path right -0.6 0.3 -0.6 0.9
path snake 0.6 0.4 -0.6 0.8
# The straight path, with heights of the root: over a jump, and down into a squat.
heights() {  # heights NAME Y
  echo "{\"points\": [{\"time\": 0, \"x\": 0, \"y\": 0.95, \"z\": 0}, {\"time\": 1.5, \"x\": 0, \"y\": 0.95, \"z\": 0.5}," \
    "{\"time\": 2, \"x\": 0, \"y\": $2, \"z\": 0.6}, {\"time\": 2.5, \"x\": 0, \"y\": 0.95, \"z\": 0.7}," \
    "{\"time\": 4, \"x\": 0, \"y\": 0.95, \"z\": 1.2}]}" >"$scratch/$1.path"
  dance "$1" 120 --path "$scratch/$1.path"
}
heights jump 1.2
heights squat 0.65
for times in 0.5 1.5; do dance "all$times" 90 --velocity "all=$times"; done
for times in 0.5 1 2; do dance "arms$times" 90 --velocity "arms=$times"; done
"$choreo" plot path "$scratch"/{left,right,snake}.npz --path "$scratch/left.path" --path "$scratch/right.path" --path "$scratch/snake.path" \
  --title "Figures 5 to 7: ways that were asked and danced" --width 700 --height 500 --out "$scratch/a.png"
"$choreo" plot left_arm "$scratch"/arms{0.5,1,2}.npz --label "half" --label "once" --label "twice" \
  --title "Figures 8 and 9: speed of the left arm" --width 700 --height 500 --out "$scratch/b.png"
pair plots
row jump "Figure 6: the root goes up, and down again"
row squat "Figure 6: the root goes down, and up again"
row left "Figure 7: a way to her left"
row right "The same keys, a way to her right"
row snake "The same keys, a way in a curve"
row all0.5 "Figure 8: all parts half as fast as usual"
row all1.5 "Figure 8: half as fast again"
row arms0.5 "Figure 9: arms half as fast as usual"
row arms2 "Arms twice as fast"
for frames in 100 150 200 250; do
  dance "$frames" "$frames"
  row "$frames" "Figure 10: $frames frames"
done
ffmpeg -v error -y "${rows[@]}" -filter_complex "vstack=inputs=$((${#rows[@]} / 2))" -c:v libwebp -quality 14 -frames:v 1 "$out"
echo "$out"
