#!/usr/bin/env bash
# Draws what changes a dance (paper F, Section 4.4): without keys other seeds and songs; with keys another seed, other keys, short and long
# intervals. A row is a dance of 24 or 8 seconds in nine pictures; key poses are framed. All begin with the same one, which is framed where
# others follow.
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
row() {  # row SECONDS TITLE SONG SEED KEYS
  local png=$scratch/${#rows[@]}.png
  mapfile -t poses <<<"$5"
  "$choreo" dance "$songs/$3/song.ogg" --seconds "$1.034" --seed "$4" "${poses[@]}" --out "$scratch/dance.npz" --report "$scratch/dance.json" >/dev/null
  local report=(--report "$scratch/dance.json")
  [[ $5 != "$start" ]] || report=()
  "$choreo" render "$scratch/dance.npz" "${report[@]}" --frames 9 --columns 9 --title "$2" --out "$png"
  rows+=(-i "$png")
}
start=$(keys 0@0)
usual=$(keys 0@0 1@2 2@4 3@6 4@8)
row 24 "No keys after the first pose: Escape from chaosland, seed 1" "Escape from chaosland" 1 "$start"
row 24 "No keys after it: the same song, seed 2" "Escape from chaosland" 2 "$start"
row 24 "No keys after it: another song, Feelings, seed 1" "Feelings" 1 "$start"
row 24 "No keys after it: another song, Metal madness, seed 1" "Metal madness" 1 "$start"
row 8 "Keys at 0, 2, 4, 6 and 8 s: Escape from chaosland, seed 1" "Escape from chaosland" 1 "$usual"
row 8 "The same keys and song, seed 2: they leave little room" "Escape from chaosland" 2 "$usual"
row 8 "Other keys" "Escape from chaosland" 1 "$(keys 0@0 4@2 5@4 6@6 1@8)"
row 8 "Short intervals: a key each second" "Escape from chaosland" 1 "$(keys 0@0 1@1 2@2 3@3 4@4 5@5 6@6 1@7 2@8)"
row 8 "Long intervals: keys at 0, 4 and 8 s" "Escape from chaosland" 1 "$(keys 0@0 1@4 2@8)"
ffmpeg -v error -y "${rows[@]}" -filter_complex "vstack=inputs=$((${#rows[@]} / 2)),scale=1600:-1,split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none" -frames:v 1 "$out"
echo "$out"
