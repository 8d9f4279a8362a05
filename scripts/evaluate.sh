#!/usr/bin/env bash
# Measures the checkpoints that ship on test clips and writes docs/tables.md, its plots and its sheets, the same of a genre in no training
# clip (docs/tables_unseen_genre.md), of the model of freely usable data (docs/tables_free.md), of ablations (docs/tables_ablations.md) and of
# controls (docs/tables_controls*.md), and the figures that docs/results.md and README.md quote.
#   scripts/evaluate.sh [--partial] [--out FOLDER] BIN_DIRECTORY RECORDINGS RUNS [EVAL_OPTION...]
# RECORDINGS holds tang2018/, dancedb/, cmu_dance/ and splits.json (docs/training.md). RUNS holds checkpoints that do not ship, as
# scripts/train_baselines.sh leaves them. Where some are not there it fails and names them; --partial leaves their rows out instead.
# --out writes elsewhere than docs/. Options of `choreo-lab eval` (--windows 1, to try this out) need it: docs/ has full settings.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
fail() { echo "evaluate.sh: $*" >&2; exit 1; }
partial='' out=$root/docs
while [[ ${1:-} == --* ]]; do
  case $1 in
    --partial) partial=1; shift ;;
    --out)
      [[ ${2:--} != -* ]] || fail "--out wants a folder"
      mkdir -p "$2"; out=$(realpath "$2"); shift 2 ;;
    *) fail "unknown option '$1'" ;;
  esac
done
(($# >= 3)) || fail "BIN_DIRECTORY, RECORDINGS and RUNS are wanted; see the head of this file"
lab=$(realpath "$1")/choreo-lab
recordings=$(realpath "$2")
runs=$(realpath -m "$3")
shift 3
[[ $# -eq 0 || $out != "$root/docs" ]] || fail "options of eval ($*) need --out"
options=("$@")
data=$root/build/data
cd "$root"

# Who has a row, and from where.
baselines=("Harvey et al. 2020=recurrent")
ablations=("no time embedding=ablation/no_time_embedding" "no key loss=ablation/no_key_loss" "frames from the start=ablation/forward_embedding"
  "no keys in training=ablation/no_keys")
full=ablation/full
controls_ablations=("one LSTM=controls/one_lstm" "fully connected controllers=controls/condition_fc" "one decoder=controls/one_decoder"
  "no velocity factors=controls/no_velocity_factors" "no key loss=controls/no_key_loss"
  "full, 8,000 updates=controls/full_long" "no key loss, 8,000 updates=controls/no_key_loss_long")
controls_full=controls/full
random_split=random_split
missing=()
others=()
checkpoint() { echo "$runs/$1/checkpoint.safetensors"; }
trained() { [[ -f $(checkpoint "$1") && ! -f $runs/$1/unfinished ]]; }  # trained RUN: to its end
rows() {  # rows NAME=RUN...: --other options of those that are there
  others=()
  for row in "$@"; do
    if trained "${row#*=}"; then others+=(--other "${row%%=*}=$(checkpoint "${row#*=}")"); fi
  done
}
for row in "${baselines[@]}" "full=$full" "${ablations[@]}" "full=$controls_full" "${controls_ablations[@]}" "random split=$random_split"; do
  trained "${row#*=}" || missing+=("\"${row%%=*}\" ($(checkpoint "${row#*=}"))")
done
if ((${#missing[@]})); then
  printf 'evaluate.sh: not there: %s\n' "${missing[@]}" >&2
  [[ $partial ]] || fail "scripts/train_baselines.sh trains them; --partial writes the tables without their rows"
fi

# Prepared once, and again where the recordings or what prepares them has changed.
stamp=$({
  find -L "$recordings/tang2018" "$recordings/dancedb" "$recordings/cmu_dance" -type f -printf '%P %s\n' | sort
  cat model/{audio,body,formats,motion}/*.{cpp,h} model/training/{*recording*,beat_grid,jolts,prepare,prepare_command,prepared_clip}.{cpp,h}
} | sha256sum)
if [[ $(cat "$data/stamp" 2>/dev/null) != "$stamp" ]]; then
  rm -rf "$data/tang2018" "$data/dancedb" "$data/cmu"
  "$lab" prepare tang2018 "$recordings/tang2018" "$data/tang2018" \
    --terms "none stated, citation asked (Tang et al. 2018); commercial music: internal use only"
  "$lab" prepare bvh "$recordings/dancedb" "$data/dancedb" --terms "none stated (Aristidou et al. 2017)"
  "$lab" prepare bvh "$recordings/cmu_dance" "$data/cmu" --frame-rate salsa 60 --terms "CMU Graphics Lab Motion Capture Database, free"
  echo "$stamp" >"$data/stamp"
fi

measure() {  # measure NAME MODEL OPTIONS...
  local name=$1 model=$2
  shift 2
  # float32: bfloat16, which some CPUs have, gives other last digits.
  "$lab" eval --engine packed --model "$model" --json "$out/images/$name.json" --markdown "$out/$name.md" \
    ${others[@]+"${others[@]}"} "$@" ${options[@]+"${options[@]}"}
  rm "$out/images/$name.json"
}
sets=(--split test --data "$data/dancedb" --data "$data/tang2018" --splits "$recordings/splits.json")

rm -f "$out"/images/tables_*.png  # of rows that are no more
rows "${baselines[@]}"
others+=(--other "free data=model/checkpoints/free.safetensors")
measure tables model/checkpoints/default.safetensors "${sets[@]}" --sheets
for sheet in "$out"/images/tables_sheet_*.png; do  # a quarter of the size
  ffmpeg -v error -y -i "$sheet" -vf "scale=800:-1,split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none" "$sheet.small.png"
  mv "$sheet.small.png" "$sheet"
done
measure tables_unseen_genre model/checkpoints/default.safetensors --split test_unseen_genre --data "$data/tang2018" \
  --splits "$recordings/splits.json" --long-dances 0 --best-of 0 --windows 32  # of its one clip; eight say little
others=()
measure tables_free model/checkpoints/free.safetensors "${sets[@]}" --name "free data" --baseline real --best-of 0

rows "${ablations[@]}"
if trained "$full"; then
  measure tables_ablations "$(checkpoint "$full")" "${sets[@]}" --name full --baseline real interpolation --long-dances 0 --best-of 0
fi

rows "${baselines[@]}"
controls=(--split test --baseline real interpolation --controls)
measure tables_controls model/checkpoints/controllers.safetensors --data "$data/dancedb" --splits "$recordings/splits.json" "${controls[@]}" all \
  --windows 4
# They stand in for paper C's cyclic motion (docs/reproduce.md). The baseline has been trained on them, the model has not.
martial=$(cd "$data/cmu" && printf '"%s", ' martial_*.clip | sed 's/\.clip//g; s/, $//')
echo "{\"cmu\": {\"test\": [$martial]}}" >"$data/martial.json"
measure tables_controls_martial model/checkpoints/controllers.safetensors --data "$data/cmu" --splits "$data/martial.json" "${controls[@]}" paper \
  --windows 4
# Paper C's own setting: those who test have other clips in training.
scripts/random_split.sh "$data/dancedb" >"$data/random.json"
random=(--data "$data/dancedb" --splits "$data/random.json" "${controls[@]}")
others=()
if trained "$random_split"; then
  measure tables_controls_random "$(checkpoint "$random_split")" "${random[@]}" all --windows 2
fi
rows "${controls_ablations[@]}"
if trained "$controls_full"; then
  measure tables_controls_ablations "$(checkpoint "$controls_full")" "${random[@]}" paper --name full --windows 1
fi

if [[ $out == "$root/docs" ]]; then scripts/quote_figures.py; fi
echo "evaluate.sh: $((SECONDS / 60)) minutes"
