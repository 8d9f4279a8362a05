#!/usr/bin/env bash
# Draws what controls do, as the figures 5 to 10 of paper C do: root paths, velocity factors, heights, and the model beside interpolation.
#   scripts/controls_gallery.sh BIN_DIRECTORY OUT_DIRECTORY
# writes controls_{paths,factors,heights,interpolation,long}.png. A row is a dance of 8 seconds, with which the camera goes along; key poses
# are framed. A chart has all dances of its picture in the one world frame.
set -euo pipefail
choreo=$1/choreo
out=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$out"

way() {  # way NAME X Z [Y]: terms of u, which runs from 0 to 1 in 8 seconds
  awk "BEGIN { printf \"{\\\"points\\\": [\"
    for (i = 0; i <= 64; ++i) {
      u = i / 64; t = 8 * u
      printf \"%s{\\\"time\\\": %.3f, \\\"x\\\": %.3f, \\\"z\\\": %.3f${4:+, \\\"y\\\": %.3f}}\", i ? \", \" : \"\", t, $2, $3${4:+, $4}
    }
    print \"]}\" }" >"$scratch/$1.json"
}
dance() {  # dance NAME WAY OPTIONS...; key poses of the library, one each two seconds
  local name=$1 path=$2
  shift 2
  "$choreo" dance --seconds 8.04 --seed 6 --path "$scratch/$path.json" "$@" --out "$scratch/$name.npz" \
    --report "$scratch/$name.report" >/dev/null
}
row() {  # row NAME TITLE
  local frames=${frames:-13}
  "$choreo" render "$scratch/$1.npz" --report "$scratch/$1.report" --frames "$frames" --columns "$frames" --title "$2" --out "$scratch/$1.png"
  rows+=("$scratch/$1.png")
}
chart() {  # chart NAME OF MOTIONS AND OPTIONS...
  local name=$1
  shift
  "$choreo" plot "$@" --out "$scratch/$name.png" --width 1800 --height "${height:-520}"
  rows+=("$scratch/$name.png")
}
sheet() {  # sheet NAME: the rows so far, one below the other
  local inputs=() scaled="" chain="" i
  for i in "${!rows[@]}"; do
    inputs+=(-i "${rows[i]}")
    scaled+="[$i]scale=1800:-1[s$i];"
    chain+="[s$i]"
  done
  ffmpeg -v error -y "${inputs[@]}" -filter_complex "${scaled}${chain}vstack=inputs=${#rows[@]}" -frames:v 1 "$out/$1.png"
  echo "$out/$1.png"
  rows=()
}
rows=()

way straight 0 "3.6 * u"
way bow "1.2 * sin(3.1416 * u)" "3.6 * u"
way snake "0.7 * sin(6.2832 * u)" "3.6 * u"
for name in straight bow snake; do
  dance "$name" "$name"
  row "$name" "The same keys, another root path: $name"
done
ways() {  # ways MOTIONS, LABELS, PATHS
  chart ways path "$@" --title "The root's way, from above; dashed: as asked"
}
height=800 ways "$scratch"/{straight,bow,snake}.npz --label straight --label bow --label snake --path "$scratch/straight.json" \
  --path "$scratch/bow.json" --path "$scratch/snake.json"
sheet controls_paths

# What x 1 is, cm a frame.
usual() {
  "$choreo" info --json | awk -v part="\"$1\":" '$1 == part { sub(",", "", $2); print 100 * $2; exit }'
}
times=(0.5 1 1.5)
for by in "${times[@]}"; do
  dance "by$by" bow --velocity "all=$by"
  row "by$by" "The same keys and path, all velocity factors x $by"
done
for part in left_arm right_leg; do
  asked=()
  for by in "${times[@]}"; do asked+=(--label "x $by" --asked "$(awk "BEGIN { print $by * $(usual $part) }")"); done
  height=420 chart "speed_$part" "$part" "$scratch"/by{0.5,1,1.5}.npz "${asked[@]}" --title "Speed of the ${part/_/ }; dashed: as asked"
done
ways "$scratch"/by{0.5,1,1.5}.npz --label "x 0.5" --label "x 1" --label "x 1.5" --path "$scratch/bow.json"
sheet controls_factors

# Between keys, whose postures stand: a squat at 1 s, a jump at 3 s, a low walk around 5 s.
way level "0.4 * sin(3.1416 * u)" "1.2 * u"
way heights "0.4 * sin(3.1416 * u)" "1.2 * u" \
  "0.94 - 0.34 * exp(-((t - 1) / 0.4) ^ 2) - 0.14 * exp(-((t - 2.55) / 0.16) ^ 2) + 0.35 * exp(-((t - 3) / 0.22) ^ 2) \
  - 0.24 * (1 / (1 + exp(-12 * (t - 4.5))) - 1 / (1 + exp(-12 * (t - 5.5))))"
dance level level
frames=17 row level "A path without heights"
dance heights heights
frames=17 row heights "The same with heights: a squat, a jump, a low walk"
chart height height "$scratch/heights.npz" "$scratch/level.npz" --label "with heights" --label "without" --path "$scratch/heights.json" \
  --title "Height of the root; dashed: as asked"
ways "$scratch/heights.npz" "$scratch/level.npz" --label "with heights" --label "without" --path "$scratch/heights.json"
sheet controls_heights

# Of the key poses alone, which stand two seconds apart, slerp makes the rest.
"$choreo" convert "$scratch/straight.npz" "$scratch/seconds.bvh" --fps 1
awk '/^Frames:/ { $2 = 5 } frames { if (n++ % 2 == 0) print; next } /^Frame Time:/ { $3 = 2; frames = 1 } { print }' \
  "$scratch/seconds.bvh" >"$scratch/keys.bvh"
"$choreo" convert "$scratch/keys.bvh" "$scratch/slerp.npz" --fps 30
cp "$scratch/straight.report" "$scratch/slerp.report"
row straight "The model, on a straight root path"
row slerp "Interpolation between the same key poses"
chart speeds left_leg "$scratch/straight.npz" "$scratch/slerp.npz" --label "the model" --label interpolation --asked "$(usual left_leg)" \
  --title "Speed of the left leg; dashed: as asked"
sheet controls_interpolation

# 250 frames without a key in between, longer than the 200 beyond which paper C's network repeats itself.
long() {  # long NAME FROM TO TITLE OPTIONS...
  local name=$1 from=$2 to=$3 title=$4
  shift 4
  "$choreo" transition --from "$from" --to "$to" -n 250 "$@" --out "$scratch/$name.npz" \
    --report "$scratch/$name.report" >/dev/null
  frames=18 row "$name" "$title"
}
way slow 0 "1.5 * u"
long lunge contrapposto side_lunge "250 frames from contrapposto to a side lunge" --velocity arms=1
long arabesque hands_on_hips arabesque "250 frames from hands on hips to an arabesque, 1.5 m ahead" --path "$scratch/slow.json"
long lively contrapposto side_lunge "The first one again, the arms x 1.5" --velocity arms=1.5
chart long left_arm "$scratch/lunge.npz" "$scratch/lively.npz" --label "x 1" --asked "$(usual left_arm)" --label "x 1.5" \
  --asked "$(awk "BEGIN { print 1.5 * $(usual left_arm) }")" --title "Speed of the left arm; dashed: as asked"
sheet controls_long
