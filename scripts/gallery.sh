#!/usr/bin/env bash
# Draws what changes a dance (paper F, Section 4.4): the same song and key poses with other seeds, other keys, another song, short and long
# intervals. A row is a dance of 8.5 seconds, a picture every half second; key poses are framed.
#   scripts/gallery.sh BIN_DIRECTORY OUT.png
set -euo pipefail
choreo=$1/choreo
out=$2
songs=/usr/share/games/fretsonfire/data/songs/sectoid
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The poses that the library would dance through, where it would have them: key I of the base dance.
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
row() {  # row TITLE SONG SEED KEYS
  local png=$scratch/${#rows[@]}.png
  mapfile -t poses <<<"$4"
  "$choreo" dance "$songs/$2/song.ogg" --seconds 8.5 --seed "$3" "${poses[@]}" --out "$scratch/dance.npz" --report "$scratch/dance.json" >/dev/null
  "$choreo" render "$scratch/dance.npz" --report "$scratch/dance.json" --frames 18 --columns 18 --title "$1" --out "$png"
  rows+=(-i "$png")
}
usual=$(keys 0@0 1@2 2@4 3@6 4@8)
row "Escape from chaosland, keys at 2, 4, 6 and 8 s, seed 1" "Escape from chaosland" 1 "$usual"
row "the same, seed 2" "Escape from chaosland" 2 "$usual"
row "the same, seed 3" "Escape from chaosland" 3 "$usual"
row "seed 1, other keys" "Escape from chaosland" 1 "$(keys 0@0 4@2 5@4 6@6 1@8)"
row "seed 1, the usual keys, another song: Feelings" "Feelings" 1 "$usual"
row "seed 1, short intervals: a key each second" "Escape from chaosland" 1 "$(keys 0@0 1@1 2@2 3@3 4@4 5@5 6@6 1@7 2@8)"
row "seed 1, long intervals: keys at 4 and 8 s" "Escape from chaosland" 1 "$(keys 0@0 1@4 2@8)"
ffmpeg -v error -y "${rows[@]}" -filter_complex "vstack=inputs=$((${#rows[@]} / 2)),scale=1800:-1" -frames:v 1 "$out"
echo "$out"
