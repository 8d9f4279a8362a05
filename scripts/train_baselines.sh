#!/usr/bin/env bash
# Trains the papers' own networks: the ablations of paper F's Table 1, and those of paper C's Tables 2 to 4 on that paper's own setting, a
# random split of clips.
#   scripts/train_baselines.sh BIN_DIRECTORY DATA SPLITS RUNS
# DATA holds tang2018/, dancedb/ and cmu/ as `choreo-lab prepare` wrote them (docs/training.md), SPLITS is splits.json. RUNS gets
# ablation/{full,no_key_loss,no_time_embedding,forward_embedding,no_keys}/ and controls/{full,one_lstm,condition_fc,one_decoder,
# no_velocity_factors,no_key_loss,full_long,no_key_loss_long}/. Killed, it goes on from where it was when it is started
# again; what is finished is not trained again.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

# Steps, windows a step and peak rates. Key losses look at roll-outs of as many frames as the tables' longest transitions.
ablation_steps=3000
ablation_rate=1e-3
ablation_batch=64
ablation_rollout=90
# Paper C's network at its lengths (5 to 70 frames).
controls_steps=2000
controls_long_steps=8000  # of two of them: does the order come with time?
controls_rate=1e-3
controls_batch=16

(($# == 4)) || { echo "train_baselines.sh: BIN_DIRECTORY, DATA, SPLITS and RUNS are wanted; see the head of this file" >&2; exit 2; }
lab=$(realpath "$1")/choreo-lab
data=$(realpath "$2")
splits=$(realpath "$3")
mkdir -p "$4"
runs=$(realpath "$4")
# On few cores one thread is fastest.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

train() {  # train RUN OPTION...
  local run=$runs/$1
  shift
  local options=$*  # without where things lie here
  options=${options//"$data"/DATA} options=${options//"$splits"/SPLITS} options=${options//"$runs"/RUNS}
  if [[ -f $run/checkpoint.safetensors && ! -f $run/unfinished ]]; then
    [[ $(cat "$run/options" 2>/dev/null || true) == "$options" ]] || { echo "train_baselines.sh: $run was trained otherwise; remove it" >&2; exit 1; }
    echo "$run is finished"
    return
  fi
  mkdir -p "$run"
  echo "$options" >"$run/options"
  touch "$run/unfinished"  # a run leaves checkpoints on its way
  "$lab" train --run "$run" --resume "$@"
  rm "$run/unfinished"
}

all=(--data "$data/tang2018" --data "$data/dancedb" --data "$data/cmu" --splits "$splits")
ablation=("${all[@]}" --preset ablation --batch "$ablation_batch" --steps "$ablation_steps" --rate "$ablation_rate"
  --rollout-frames "$ablation_rollout")
train ablation/full "${ablation[@]}"
train ablation/no_key_loss "${ablation[@]}" --no-key-loss
train ablation/no_time_embedding "${ablation[@]}" --no-time-embedding
train ablation/forward_embedding "${ablation[@]}" --forward-embedding
train ablation/no_keys "${ablation[@]}" --no-keys

"$root/scripts/random_split.sh" "$data/dancedb" >"$runs/random_split.json"
random=(--data "$data/dancedb" --splits "$runs/random_split.json")
paper_c=("${random[@]}" --preset controllers-paper --longest 70 --batch "$controls_batch" --rate "$controls_rate")
controls=("${paper_c[@]}" --steps "$controls_steps")
controls_long=("${paper_c[@]}" --steps "$controls_long_steps")
train controls/full "${controls[@]}"
train controls/one_lstm "${controls[@]}" --one-lstm
train controls/condition_fc "${controls[@]}" --condition-fc
train controls/one_decoder "${controls[@]}" --one-decoder
train controls/no_velocity_factors "${controls[@]}" --no-velocity-factors
train controls/no_key_loss "${controls[@]}" --no-key-loss
train controls/full_long "${controls_long[@]}"
train controls/no_key_loss_long "${controls_long[@]}" --no-key-loss
