#!/usr/bin/env bash
# scripts/train_papers.sh trains both papers' networks and a baseline of a folder of BVH files, without Tang's recordings, in a few steps, trains
# nothing twice, and measures what it trained.
#   tests/lab/train_papers_script.sh BUILD_DIRECTORY
set -euo pipefail
bin=$(realpath "$1")/bin
train=$(realpath "$(dirname "$0")/../../scripts/train_papers.sh")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
recordings="$scratch/my recordings"
mkdir -p "$recordings/dancedb"
for clip in a b c d; do
  "$bin/choreo" dance --keyframes none --seconds 15 --seed "$(cksum <<<"$clip" | cut -c1-6)" --out "$recordings/dancedb/$clip.bvh" >/dev/null 2>&1
done
echo '{"dancedb": {"validation": ["a"], "test": ["b"]}}' >"$recordings/splits.json"
export F_STEPS=2 F_BATCH=4 C_STEPS=2 C_BATCH=4 HARVEY_STEPS=2 HARVEY_BATCH=4 WINDOWS=1 LONG_DANCES=0
networks=(paper-f paper-c c-harvey)
"$train" "$bin" "$recordings" "$scratch/run" train "${networks[@]}" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
for network in "${networks[@]}"; do [[ -f $scratch/run/$network/checkpoint.safetensors ]]; done
# A random fifth of the other dancers' clips is held back for the paper's kind of split.
grep -qE '"test_random": \["(c|d)"\]' "$scratch/run/random_splits.json"
"$train" "$bin" "$recordings" "$scratch/run" train "${networks[@]}" >"$scratch/again"
(($(grep -c "is finished" "$scratch/again") == ${#networks[@]}))
"$train" "$bin" "$recordings" "$scratch/run" eval >"$scratch/eval"
grep -q '"method": "paper-f, raw"' "$scratch/run/paper_f.json"
grep -q '"method": "default"' "$scratch/run/paper_f.json"
grep -q '"method": "paper-c, network alone"' "$scratch/run/paper_c_random.json"
grep -q "f_ablations is not measured: f-full is not trained" "$scratch/eval"
