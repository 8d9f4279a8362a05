#!/usr/bin/env bash
# Measures the shipped checkpoint on test clips, writes docs/figures/*.json, and updates their quotes in docs/results.md.
#   scripts/evaluate.sh BIN_DIRECTORY RECORDINGS [EVAL_OPTION...]
# RECORDINGS holds dancedb/, splits.json (docs/training.md) and music/, songs in Ogg files. Six minutes of one core.
set -euo pipefail
(($# >= 2)) || { echo "evaluate.sh: BIN_DIRECTORY and RECORDINGS are wanted; see the head of this file" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
lab=$(realpath "$1")/choreo-lab
recordings=$(realpath "$2")
shift 2
cd "$root"

# Prepared once, and again if the recordings or the code have changed.
data=build/data
stamp=$({
  find -L "$recordings/dancedb" -type f -printf '%P %s\n' | sort
  cat model/{body,fit,fit/*,formats,formats/*,motion,motion/*}/*.{cpp,h} model/training/{prepare/*,clips/prepared_clip.*}
} | sha256sum)
if [[ $(cat "$data/stamp" 2>/dev/null) != "$stamp" ]]; then
  rm -rf "$data/dancedb"
  "$lab" prepare bvh "$recordings/dancedb" "$data/dancedb" --terms "none stated (Aristidou et al. 2017)"
  echo "$stamp" >"$data/stamp"
fi

"$lab" eval --liveliness --model model/checkpoints/default.safetensors --data "$data/dancedb" --splits "$recordings/splits.json" \
  --split test --json docs/figures/liveliness.json "$@"
controls() {  # KIND JSON [OPTION...]
  "$lab" eval --controls "$1" --model model/checkpoints/default.safetensors --data "$data/dancedb" --splits "$recordings/splits.json" \
    --split test --windows 3 --no-encoder --json "docs/figures/$2.json" "${@:3}"
}
controls all controls
controls paper controls_mean --temperature 0
"$lab" eval --music "$recordings"/music/*.ogg --model model/checkpoints/default.safetensors --json docs/figures/hearing.json
sed -i '/"fingerprint"/d' docs/figures/*.json  # of a build, which is another everywhere
scripts/quote_figures.py
