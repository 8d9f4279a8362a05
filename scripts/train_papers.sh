#!/usr/bin/env bash
# Trains the papers' own networks, their ablations and their baseline, and measures them.
#   scripts/train_papers.sh BIN_DIRECTORY RECORDINGS RUN [prepare | train [NAME...] | eval | study]
# RECORDINGS holds dancedb/, splits.json and, for its songs, tang61/ (docs/training.md). RUN gets data/, a folder for each network, and tables
# (JSON). Without a task it prepares, trains and measures. `study` films paper-f, paper-c, default, interpolation and real dancers to songs and
# writes RUN/study/index.html, where people rank them. `eval` and `study` take the paper-f and paper-c that ship where RUN has none.
# `train` alone makes paper-f and paper-c; NAME is any of
#   paper-f paper-f-printed (without the loss of whole roll-outs) f-full f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys
#   paper-c c-full c-residual c-absolute c-relative c-one-lstm c-condition-fc c-one-decoder c-no-velocity-factors c-no-key-loss
#   harvey, and c-harvey, which knows paper C's data alone
# or `all` for every one. Killed, it goes on from where it was when it is started again; what is finished is not trained again.
# $F_STEPS, $C_STEPS and $HARVEY_STEPS are the steps of the networks, $F_ABLATION_STEPS and $C_ABLATION_STEPS those of all that are compared with
# f-full and c-full, which are paper-f-printed and paper-c (with transitions of at most 70 frames) of as few. $DEVICE says where flows train: cpu,
# cuda:0, auto. $WINDOWS and $LONG_DANCES are how many transitions of each clip and dances `eval` measures.
set -euo pipefail
(($# >= 3)) || { echo "train_papers.sh: BIN_DIRECTORY, RECORDINGS and RUN are wanted; see the head of this file" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
lab=$1/choreo-lab
[[ -x $lab ]] || { echo "train_papers.sh: there is no choreo-lab in BIN_DIRECTORY '$1'" >&2; exit 2; }
lab=$(realpath "$lab")
recordings=$(realpath "$2")
mkdir -p "$3"
run=$(realpath "$3")
task=${4:-everything}
shift $(($# < 4 ? $# : 4))
# On few cores one thread is fastest.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

has_tang61() { [[ -d $recordings/tang61 ]]; }
prepare_tang61() {  # only paper F's networks and the study use it
  ! has_tang61 || [[ -f $run/data/tang61/report.json ]] || "$lab" prepare tang61 "$recordings/tang61" "$run/data/tang61" \
    --terms "none stated (Tang et al. 2018); commercial music: internal use only"
}
prepare_dancedb() {
  [[ -f $run/data/dancedb/report.json ]] ||
    "$lab" prepare bvh "$recordings/dancedb" "$run/data/dancedb" --terms "none stated (Aristidou et al. 2017)"
  # Paper C's test clips are a random fifth, of dancers who train too. Here they are that of the dancers who are in neither of our groups, so
  # that one network is measured on both: `test_random`, and `test`, a dancer whom it never saw.
  /usr/bin/python3 - "$recordings/splits.json" "$run/data/dancedb" >"$run/random_splits.json" <<'PYTHON'
import hashlib, json, pathlib, sys
groups = {k: v for k, v in json.load(open(sys.argv[1]))["dancedb"].items() if k in ("test", "validation")}
held = {name for names in groups.values() for name in names}
others = sorted((clip.stem for clip in pathlib.Path(sys.argv[2]).glob("*.clip") if clip.stem not in held),
                key=lambda name: hashlib.sha256(name.encode()).hexdigest())
groups["test_random"] = others[: max(1, round(len(others) / 5))]
json.dump({"dancedb": groups}, sys.stdout)
PYTHON
}

# The papers train for some 40 hours on a GPU at 1e-4; so few steps want a higher rate. A step of paper F's with roll-outs takes three times as
# long as one of likelihood alone, and samples are noise at first: the last third has them. Paper C's transitions grow from 5 to 70 frames, in
# paper-c to 150, the longest that is measured.
f_steps=${F_STEPS:-9000} f_batch=${F_BATCH:-16}
c_steps=${C_STEPS:-7500} c_batch=${C_BATCH:-32}
harvey_steps=${HARVEY_STEPS:-1500} harvey_batch=${HARVEY_BATCH:-32}

train() {  # train NAME STEPS OPTION...
  local folder=$run/$1 name=$1 steps=$2
  shift 2
  if [[ -f $folder/finished ]]; then
    echo "$folder is finished"
    return
  fi
  "$lab" train --name "$name" --run "$folder" --steps "$steps" --rate 0.001 --resume "$@"
  touch "$folder/finished"
}
clips=("$run/data/dancedb")
! has_tang61 || clips+=("$run/data/tang61")
both=(--data "${clips[@]}" --splits "$recordings/splits.json" --shortest 10 --longest 90)
dancedb=(--data "$run/data/dancedb" --splits "$run/random_splits.json")
flow() {  # flow NAME STEPS OPTION...
  prepare_tang61
  train "$1" "$2" --preset paper-f "${both[@]}" --batch "$f_batch" --rollout-from $(($2 * 2 / 3)) --device "${DEVICE:-cpu}" "${@:3}"
}
controllers() {  # controllers NAME STEPS OPTION...; $longest: of its transitions
  # The real frames' share falls from 1 to a hundredth, as after 92,000 steps of the paper's 0.99995.
  local decay
  decay=$(awk -v n="$2" 'BEGIN { printf "%.6f", exp(log(0.01) / n) }')
  train "$1" "$2" --preset controllers-paper "${dancedb[@]}" --batch "$c_batch" --longest "${longest:-70}" --truth-decay "$decay" "${@:3}"
}
one() {
  local f=${F_ABLATION_STEPS:-$f_steps} c=${C_ABLATION_STEPS:-$c_steps}
  case $1 in
    paper-f) flow paper-f "$f_steps" --rollout-loss 2 ;;
    paper-f-printed) flow "$1" "$f_steps" ;;
    f-full) flow f-full "$f" ;;
    f-no-key-loss) flow "$1" "$f" --no-key-loss ;;
    f-no-time-embedding) flow "$1" "$f" --no-time-embedding ;;
    f-forward-embedding) flow "$1" "$f" --forward-embedding ;;
    f-no-keys) flow "$1" "$f" --no-keys ;;
    paper-c) longest=150 controllers paper-c "$c_steps" ;;
    c-full) controllers c-full "$c" ;;
    c-residual) controllers "$1" "$c" --residual ;;
    c-absolute) controllers "$1" "$c" --no-relative-position ;;
    c-relative) controllers "$1" "$c" --no-absolute-position ;;
    c-one-lstm) controllers "$1" "$c" --one-lstm ;;
    c-condition-fc) controllers "$1" "$c" --condition-fc ;;
    c-one-decoder) controllers "$1" "$c" --one-decoder ;;
    c-no-velocity-factors) controllers "$1" "$c" --no-velocity-factors ;;
    c-no-key-loss) controllers "$1" "$c" --no-key-loss ;;
    harvey)
      prepare_tang61
      train harvey "$harvey_steps" --preset harvey "${both[@]}" --batch "$harvey_batch"
      ;;
    c-harvey) train c-harvey "$harvey_steps" --preset harvey "${dancedb[@]}" --shortest 10 --longest 90 --batch "$harvey_batch" ;;
    *) echo "train_papers.sh: there is no network '$1'; see the head of this file" >&2; exit 2 ;;
  esac
}

checkpoint_of() {  # checkpoint_of NAME: of the run or, if it has none, the one that ships
  if [[ -f $run/$1/finished ]]; then
    echo "$run/$1/checkpoint.safetensors"
  elif [[ -f $root/model/checkpoints/$1.safetensors ]]; then
    echo "$root/model/checkpoints/$1.safetensors"
  fi
}
# Rows beside the judged network: all others.
others=()
beside() {  # beside NAME...
  local name checkpoint
  others=()
  for name in "$@"; do
    checkpoint=$(checkpoint_of "$name")
    [[ -z $checkpoint ]] || others+=(--other "$name=$checkpoint")
  done
}
measure() {  # measure NAME JSON OPTION...: nothing of a network that does not exist
  local checkpoint
  checkpoint=$(checkpoint_of "$1")
  if [[ -z $checkpoint ]]; then
    echo "train_papers.sh: $2 is not measured: $1 is not trained"
    return
  fi
  "$lab" eval --model "$checkpoint" --name "$1" --json "$run/$2.json" "${@:3}"
}
evaluate() {
  prepare_dancedb
  prepare_tang61
  local baselines=(--baseline real interpolation)
  local f=(--paper --data "${clips[@]}" --splits "$recordings/splits.json" --split test --lengths 30 60 90
    --windows "${WINDOWS:-6}" --long-dances "${LONG_DANCES:-14}" --long-frames 600)
  beside default paper-f-printed
  measure paper-f paper_f "${f[@]}" --best-of 10 "${baselines[@]}" "${others[@]}"
  measure harvey harvey_f "${f[@]}" --best-of 1 --no-encoder --baseline interpolation  # it draws nothing
  measure paper-f paper_f_calm "${f[@]}" --best-of 3 --long-dances 6 --temperature 0.6 --no-encoder --baseline interpolation
  beside f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys
  measure f-full f_ablations "${f[@]}" --best-of 3 --long-dances 6 --baseline interpolation "${others[@]}"
  local c=(--controls paper --splits "$run/random_splits.json" --data "$run/data/dancedb" --windows "${WINDOWS:-4}" --no-encoder "${baselines[@]}")
  beside c-harvey
  # `default` learnt from the clips of the random fifth.
  measure paper-c paper_c_random "${c[@]}" --split test_random "${others[@]}"
  beside default harvey
  measure paper-c paper_c_unseen "${c[@]}" --split test "${others[@]}"
  beside c-residual c-no-velocity-factors c-no-key-loss
  measure c-full c_ablations "${c[@]}" --split test_random "${others[@]}"
  beside c-one-decoder c-condition-fc
  measure c-one-lstm c_ablations_shape "${c[@]}" --split test_random "${others[@]}"
  beside c-relative
  measure c-absolute c_ablations_coding "${c[@]}" --split test_random "${others[@]}"
}

study() {
  prepare_dancedb
  prepare_tang61
  beside paper-f paper-c
  "$lab" study dance "$run/study" --model "$root/model/checkpoints/default.safetensors" --name default "${others[@]}" \
    --data "$run/data/tang61" --splits "$recordings/splits.json" --songs "$recordings/tang61"
}

all=(paper-f paper-f-printed paper-c harvey c-harvey f-full f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys c-full c-residual
  c-absolute c-relative c-one-lstm c-condition-fc c-one-decoder c-no-velocity-factors c-no-key-loss)
names=("$@")
((${#names[@]})) || names=(paper-f paper-c)
[[ ${names[*]} != all ]] || names=("${all[@]}")
case $task in
  prepare)
    prepare_dancedb
    prepare_tang61
    ;;
  train)
    prepare_dancedb
    for name in "${names[@]}"; do one "$name"; done
    ;;
  eval) evaluate ;;
  study) study ;;
  everything)
    prepare_dancedb
    for name in "${names[@]}"; do one "$name"; done
    evaluate
    ;;
  *) echo "train_papers.sh: '$task' is none of prepare, train, eval, study" >&2; exit 2 ;;
esac
