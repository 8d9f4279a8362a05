#!/usr/bin/env bash
# Trains what docs/results.md compares the models with: the baseline of Harvey et al. 2020, the ablations of paper F's Table 1, and those of
# paper C's Tables 2 to 4; and the network with controls on that paper's own setting, a random split of clips.
#   scripts/train_baselines.sh BIN_DIRECTORY DATA SPLITS RUNS
# DATA holds tang2018/, dancedb/ and cmu/ as `choreo-lab prepare` wrote them (docs/training.md), SPLITS is splits.json. RUNS gets recurrent/
# (and recurrent_start/, from which it goes on), ablation/{full,no_key_loss,no_time_embedding,forward_embedding,no_keys}/,
# random_split/ (and random_start/, random_more/, random_further/) and controls/{full,one_lstm,condition_fc,one_decoder,no_velocity_factors,
# no_key_loss,full_long,no_key_loss_long}/, where scripts/evaluate.sh looks for them. Killed, it goes on from where it was when it is started
# again; what is finished is not trained again.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

# Steps, windows a step and peak rates. The baseline sees as many windows as the planner that ships; rates fall to nothing in each of its two
# runs. An ablation is a small flow without a planner, whose key loss looks at roll-outs of as many frames as its tables' longest transitions.
recurrent_steps=(20000 13750)
recurrent_rates=(8e-4 5e-4)
recurrent_batch=64
ablation_steps=3000
ablation_rate=1e-3
ablation_batch=64
ablation_rollout=90
# The network that ships, on paper C's setting (scripts/random_split.sh): in several runs as well, but on longer windows.
random_steps=(10000 12000 12000 12000)
random_rates=(1e-3 8e-4 8e-4 8e-4)
random_walks=(1500 500 500 500)  # updates that walk, behind those of the plan
random_batch=32
# Paper C's network without a plan, its lengths (5 to 70 frames), on the same.
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
recurrent=("${all[@]}" --preset recurrent --batch "$recurrent_batch" --flow-steps 1)  # it has no flow: the one step does nothing
train recurrent_start "${recurrent[@]}" --planner-steps "${recurrent_steps[0]}" --planner-rate "${recurrent_rates[0]}"
train recurrent "${recurrent[@]}" --planner "$runs/recurrent_start/checkpoint.safetensors" --planner-steps "${recurrent_steps[1]}" \
  --planner-rate "${recurrent_rates[1]}"

ablation=("${all[@]}" --preset ablation --batch "$ablation_batch" --flow-steps "$ablation_steps" --flow-rate "$ablation_rate"
  --rollout-frames "$ablation_rollout")
train ablation/full "${ablation[@]}"
train ablation/no_key_loss "${ablation[@]}" --no-key-loss
train ablation/no_time_embedding "${ablation[@]}" --no-time-embedding
train ablation/forward_embedding "${ablation[@]}" --forward-embedding
train ablation/no_keys "${ablation[@]}" --no-keys

"$root/scripts/random_split.sh" "$data/dancedb" >"$runs/random_split.json"
random=(--data "$data/dancedb" --splits "$runs/random_split.json")
random_controllers=("${random[@]}" --preset controllers --longest 250 --batch "$random_batch")
before=()
number=0
for run in random_start random_more random_further random_split; do
  train "$run" "${random_controllers[@]}" "${before[@]}" --planner-steps "${random_steps[number]}" --planner-rate "${random_rates[number]}" \
    --flow-steps "${random_walks[number]}"
  before=(--planner "$runs/$run/checkpoint.safetensors")
  number=$((number + 1))
done
paper_c=("${random[@]}" --preset controllers-paper --longest 70 --batch "$controls_batch" --flow-rate "$controls_rate")
controls=("${paper_c[@]}" --flow-steps "$controls_steps")
controls_long=("${paper_c[@]}" --flow-steps "$controls_long_steps")
train controls/full "${controls[@]}"
train controls/one_lstm "${controls[@]}" --one-lstm
train controls/condition_fc "${controls[@]}" --condition-fc
train controls/one_decoder "${controls[@]}" --one-decoder
train controls/no_velocity_factors "${controls[@]}" --no-velocity-factors
train controls/no_key_loss "${controls[@]}" --no-key-loss
train controls/full_long "${controls_long[@]}"
train controls/no_key_loss_long "${controls_long[@]}" --no-key-loss
