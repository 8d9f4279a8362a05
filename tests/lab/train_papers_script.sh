#!/usr/bin/env bash
# scripts/train_papers.sh trains paper C's network and its baseline of a folder of BVH files, without Tang's recordings, in a few steps, and
# trains nothing twice.
#   tests/lab/train_papers_script.sh BUILD_DIRECTORY
set -euo pipefail
bin=$(realpath "$1")/bin
train=$(realpath "$(dirname "$0")/../../scripts/train_papers.sh")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
recordings="$scratch/my recordings"
mkdir -p "$recordings/dancedb"
for clip in a b c d; do
  "$bin/choreo" dance --keyframes none --seconds 15 --seed "$(cksum <<<"$clip" | cut -c1-6)" --out "$recordings/dancedb/$clip.bvh" >/dev/null
done
echo '{"dancedb": {"validation": ["a"], "test": ["b"]}}' >"$recordings/splits.json"
export C_STEPS=2 C_BATCH=2 HARVEY_STEPS=2 HARVEY_BATCH=2
"$train" "$bin" "$recordings" "$scratch/run" train paper-c c-harvey >/dev/null
[[ -f $scratch/run/paper-c/checkpoint.safetensors && -f $scratch/run/c-harvey/checkpoint.safetensors ]]
# A random fifth of the other dancers' clips is held back for the paper's kind of split.
grep -qE '"test_random": \["(c|d)"\]|"test_random": \[\]' "$scratch/run/random_splits.json"
"$train" "$bin" "$recordings" "$scratch/run" train paper-c c-harvey >"$scratch/again"
(($(grep -c "is finished" "$scratch/again") == 2))
