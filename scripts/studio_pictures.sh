#!/usr/bin/env bash
# Makes docs/images/studio*.jpg of the pictures that tests/studio/browser/run.sh leaves.
#   studio_pictures.sh PICTURES_FOLDER
set -euo pipefail
images=$(cd "$(dirname "$0")/../docs/images" && pwd)
while read -r from to; do
  ffmpeg -nostdin -v error -y -i "$1/$from-light.png" -vf scale=1200:-1:flags=lanczos -q:v 6 "$images/$to.jpg"
done <<'LIST'
1600 studio
pose-1600 studio_parts
path-1600 studio_path
photo-1600 studio_photo
LIST
