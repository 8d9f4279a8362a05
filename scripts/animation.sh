#!/usr/bin/env bash
# Makes docs/images/dance.webp: twenty seconds of a dance through library poses, which are framed.
#   scripts/animation.sh BIN_DIRECTORY OUT.webp
set -euo pipefail
(($# == 2)) || { echo "animation.sh: BIN_DIRECTORY and OUT.webp are wanted" >&2; exit 2; }
song="/usr/share/games/fretsonfire/data/songs/sectoid/Escape from chaosland/song.ogg"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1/choreo" dance "$song" --seconds 20 --seed 1 --out "$scratch/dance.npz" --report "$scratch/report.json"
"$1/choreo" render "$scratch/dance.npz" --report "$scratch/report.json" --video "$scratch/dance.mp4" --size 800x720 --fps 12
# Small enough for a page: whitens the wall and smooths the film's grain, so that most of a frame repeats the one before.
ffmpeg -v error -y -i "$scratch/dance.mp4" -vf "hqdn3d=0:0:8:8,scale=320:288:flags=area,colorlevels=rimax=0.93:gimax=0.93:bimax=0.915" \
  -c:v libwebp_anim -compression_level 5 -q:v 20 -loop 0 "$2"
