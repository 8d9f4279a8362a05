#!/usr/bin/env bash
# Trains the models in model/checkpoints/, or your own, from recordings: prepares them, trains on all of them, then on those of the
# kind that it shall dance like. Four hours on one core. Killed and started again, it continues from where it was.
#   scripts/train.sh BIN_DIRECTORY RECORDINGS RUN [default|free|NAME]
# RECORDINGS holds a folder per set, with BVH files (except Tang's), and splits.json (docs/training.md). RUN gets data/, all/, and
# last/checkpoint.safetensors. `default` uses five sets, `free` CMU's two, a model with another name all sets.
# $STEPS and $LAST_STEPS are the steps of the two runs, $LAST the sets of the second, $DEVICE where: cpu, cuda:0, auto.
set -euo pipefail
(($# == 3 || $# == 4)) || { echo "train.sh: BIN_DIRECTORY, RECORDINGS and RUN are wanted; see the head of this file" >&2; exit 2; }
lab=$(realpath "$1")/choreo-lab
recordings=$(realpath "$2")
mkdir -p "$3"
run=$(realpath "$3")
name=${4:-default}
# On few cores one thread is fastest.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

case $name in
  default) sets=(dancedb cmu_dance tang61 perfume cmu_modern) last=(dancedb) ;;
  free) sets=(cmu_dance cmu_modern) last=("${sets[@]}") ;;
  *) mapfile -t sets < <(find "$recordings" -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort) && last=("${sets[@]}") ;;
esac
[[ -z ${LAST:-} ]] || read -ra last <<<"$LAST"

prepare() {  # prepare SET: what it is written in, and what its headers have wrong
  local layout=bvh options=()
  case $1 in
    tang61 | tang2018) layout=$1 ;;
    cmu_dance) options=(--frame-rate salsa 60) ;;
  esac
  [[ -f $run/data/$1/report.json ]] || "$lab" prepare "$layout" "$recordings/$1" "$run/data/$1" "${options[@]}"
}
train() {  # train FOLDER OPTION...
  local folder=$run/$1
  shift
  if [[ -f $folder/finished ]]; then
    echo "$folder is finished"
    return
  fi
  "$lab" train --preset default --name "$name" --splits "$recordings/splits.json" --batch 48 --tempo 0.3 --device "${DEVICE:-cpu}" --run "$folder" --resume "$@"
  touch "$folder/finished"
}
of() { printf -- '--data\n%s\n' "${@/#/$run/data/}"; }  # of SET...

for set in "${sets[@]}"; do prepare "$set"; done
mapfile -t data < <(of "${sets[@]}")
train all "${data[@]}" --steps "${STEPS:-36000}" --rate 0.001
mapfile -t data < <(of "${last[@]}")
train last "${data[@]}" --steps "${LAST_STEPS:-14000}" --rate 0.0006 --from "$run/all/checkpoint.safetensors"
echo "$run/last/checkpoint.safetensors"
