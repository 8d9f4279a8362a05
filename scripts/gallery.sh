#!/usr/bin/env bash
# Draws what changes a dance (paper F, Figures 6 to 9): the same keys and song with other seeds, other keys, other songs, short and long intervals.
# A row is a dance of 4, 8 or 24 seconds in nine pictures; key poses are framed.
#   scripts/gallery.sh BIN_DIRECTORY OUT.webp [MODEL]
set -euo pipefail
(($# >= 2)) || { echo "gallery.sh: BIN_DIRECTORY and OUT.webp are wanted" >&2; exit 2; }
choreo=$1/choreo
out=$2
model=${3:-default}
songs=/usr/share/games/fretsonfire/data/songs/sectoid
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The library's own choice of poses and times: key I of the base dance.
"$choreo" dance "$songs/Escape from chaosland/song.ogg" --seconds 12 --seed 1 --out "$scratch/base.npz" --report "$scratch/base.json" >/dev/null
mapfile -t times < <(grep '"frame"' "$scratch/base.json" | awk '{printf "%.4f\n", $2 / 30}')
if ((${#times[@]} < 7)); then
  echo "gallery.sh: the base dance has ${#times[@]} keys, 7 are wanted" >&2
  exit 1
fi
keys() {  # keys I@SECOND...
  local names=()
  for key in "$@"; do names+=(-k "$scratch/base.npz@${times[${key%@*}]}=${key#*@}"); done
  printf '%s\n' "${names[@]}"
}
rows=()
row() {  # row SECONDS TITLE SONG SEED KEYS
  local png=$scratch/${#rows[@]}.png
  mapfile -t poses <<<"$5"
  "$choreo" dance "$songs/$3/song.ogg" --model "$model" --seconds "$1.034" --seed "$4" "${poses[@]}" --out "$scratch/dance.npz" \
    --report "$scratch/dance.json" >/dev/null
  "$choreo" render "$scratch/dance.npz" --report "$scratch/dance.json" --frames 9 --columns 9 --title "$2" --out "$png"
  rows+=(-i "$png")
}
usual=$(keys 0@0 1@2 2@4 3@6 4@8)
row 8 "Keys at 0, 2, 4, 6 and 8 s: Escape from chaosland, seed 1" "Escape from chaosland" 1 "$usual"
row 8 "Figure 6: the same keys and song, seed 2" "Escape from chaosland" 2 "$usual"
row 8 "Figure 7: the same song and seed, other keys" "Escape from chaosland" 1 "$(keys 0@0 4@2 5@4 6@6 1@8)"
row 8 "Figure 8: the same keys, another song, Feelings" "Feelings" 1 "$usual"
row 4 "Figure 9a: short intervals, keys at 0, 1, 2, 3 and 4 s" "Escape from chaosland" 1 "$(keys 0@0 1@1 2@2 3@3 4@4)"
row 24 "Figure 9b: long intervals, keys at 0, 6, 12, 18 and 24 s" "Metal madness" 1 "$(keys 0@0 1@6 2@12 3@18 4@24)"
ffmpeg -v error -y "${rows[@]}" -filter_complex "vstack=inputs=$((${#rows[@]} / 2)),scale=900:-1" -c:v libwebp -quality 40 -frames:v 1 "$out"
echo "$out"
