#!/usr/bin/env bash
# Measures the checkpoints that ship on test clips and writes docs/tables.md, its plots and its sheets.
#   scripts/evaluate.sh BIN_DIRECTORY RECORDINGS [RUNS]
# RECORDINGS holds tang2018/, dancedb/ and splits.json (docs/training.md). RUNS holds checkpoints that do not ship, as `train --run` leaves
# them: recurrent/ (Harvey et al. 2020), ablation/full, no_key_loss, no_time_embedding, forward_embedding, no_keys. Rows of those that are
# not there are left out, and named.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
lab=$(realpath "$1")/choreo-lab
recordings=$(realpath "$2")
runs=$(realpath -m "${3:-$root/runs}")
data=$root/build/data
cd "$root"

# Prepared once; remove build/data after a change of recordings or of `prepare`.
[[ -f $data/tang2018/report.json ]] || "$lab" prepare tang2018 "$recordings/tang2018" "$data/tang2018" \
  --terms "none stated, citation asked (Tang et al. 2018); commercial music: internal use only"
[[ -f $data/dancedb/report.json ]] || "$lab" prepare bvh "$recordings/dancedb" "$data/dancedb" --terms "none stated (Aristidou et al. 2017)"

others=()
row() {  # row NAME RUN: a further method, if its checkpoint is there
  if [[ -f $runs/$2/checkpoint.safetensors ]]; then
    others+=(--other "$1=$runs/$2/checkpoint.safetensors")
  else
    echo "evaluate.sh: no row \"$1\": $runs/$2/checkpoint.safetensors is not there" >&2
  fi
}
measure() {  # measure NAME MODEL OPTIONS...
  local name=$1 model=$2
  shift 2
  "$lab" eval --model "$model" --data "$data/dancedb" --data "$data/tang2018" --splits "$recordings/splits.json" --split test \
    --json "docs/images/$name.json" --markdown "docs/$name.md" ${others[@]+"${others[@]}"} "$@"
  rm "docs/images/$name.json"
}

row "Harvey et al. 2020" recurrent
others+=(--other "free data=model/checkpoints/free.safetensors")
measure tables model/checkpoints/default.safetensors --sheets
for sheet in docs/images/tables_sheet_*.png; do  # a quarter of the size
  ffmpeg -v error -y -i "$sheet" -vf "scale=800:-1,split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none" "$sheet.small.png"
  mv "$sheet.small.png" "$sheet"
done

others=()
row "no time embedding" ablation/no_time_embedding
row "no key loss" ablation/no_key_loss
row "frames from the start" ablation/forward_embedding
row "no keys in training" ablation/no_keys
full=$runs/ablation/full/checkpoint.safetensors
if [[ -f $full ]]; then
  measure tables_ablations "$full" --baseline real interpolation --long-dances 0 --best-of 0
else
  echo "evaluate.sh: no tables of ablations: $full is not there" >&2
fi
