#!/usr/bin/env bash
# scripts/train.sh makes a model of folders of BVH files, in a few steps, and goes on where it was.
#   tests/lab/train_script.sh BUILD_DIRECTORY
set -euo pipefail
bin=$(realpath "$1")/bin
train=$(realpath "$(dirname "$0")/../../scripts/train.sh")
scratch=$(mktemp -d)
server=
trap '[[ -z $server ]] || kill "$server"; rm -rf "$scratch"' EXIT
recordings="$scratch/my recordings"
for clip in slow/a slow/b quick/a quick/b; do
  mkdir -p "$recordings/${clip%/*}"
  "$bin/choreo" dance --keyframes none --seconds 15 --seed "$(cksum <<<"$clip" | cut -c1-6)" --out "$recordings/$clip.bvh" >/dev/null
done
echo '{"slow": {"validation": ["b"]}, "quick": {"validation": ["b"]}}' >"$recordings/splits.json"
STEPS=3 LAST_STEPS=2 LAST=quick "$train" "$bin" "$recordings" "$scratch/run" mine >"$scratch/said"
model=$(tail -1 "$scratch/said")
"$bin/choreod" --checkpoint "$model" --listen 127.0.0.1:0 >"$scratch/server" 2>&1 &
server=$!
until grep -q "listens on" "$scratch/server"; do
  kill -0 "$server" || exit 1
  sleep 0.1
done
kill "$server"
wait "$server"
server=
grep -q 'model "mine"' "$scratch/server"
# The last run had the sets of $LAST alone.
grep -aqF "train --data quick --splits" "$model"
"$train" "$bin" "$recordings" "$scratch/run" mine >"$scratch/again"
(($(grep -c "is finished" "$scratch/again") == 2))
