#!/usr/bin/env bash
# Trains the papers' own networks and their ablations, and measures them.
#   scripts/train_papers.sh BIN_DIRECTORY RECORDINGS RUN [prepare | train [NAME...] | eval]
# RECORDINGS holds dancedb/, tang61/ and splits.json (docs/training.md). RUN gets data/ and a folder for each network. All three things are
# done where none is named. `train` alone makes paper-f and paper-c; NAME is any of
#   paper-f f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys
#   paper-c c-residual c-absolute c-relative c-one-lstm c-condition-fc c-one-decoder c-no-velocity-factors c-no-key-loss
# or `all` for every one. Killed, it goes on from where it was when it is started again; what is finished is not trained again.
# $F_FIRST, $F_STEPS, $C_FIRST, $C_SECOND and $C_STEPS are the steps of each part, $F_ABLATION_STEPS and $C_ABLATION_STEPS those of the others'
# last one, beside which `eval` wants f-full and c-full of as many. $DEVICE says where flows train: cpu, cuda:0, auto.
set -euo pipefail
(($# >= 3)) || { echo "train_papers.sh: BIN_DIRECTORY, RECORDINGS and RUN are wanted; see the head of this file" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
lab=$(realpath "$1")/choreo-lab
recordings=$(realpath "$2")
mkdir -p "$3"
run=$(realpath "$3")
task=${4:-everything}
shift $(($# < 4 ? $# : 4))
# On few cores one thread is fastest.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

prepare() {
  [[ -f $run/data/dancedb/report.json ]] ||
    "$lab" prepare bvh "$recordings/dancedb" "$run/data/dancedb" --terms "none stated (Aristidou et al. 2017)"
  [[ -f $run/data/tang61/report.json ]] || "$lab" prepare tang61 "$recordings/tang61" "$run/data/tang61"
  # Paper C's test clips are a random fifth, of dancers who train too. Here they are that of the dancers who are in neither of our groups, so
  # that one network is measured on both: `test_random`, and `test`, a dancer whom it never saw.
  /usr/bin/python3 - "$recordings/splits.json" "$run/data/dancedb" >"$run/random_splits.json" <<'PYTHON'
import hashlib, json, pathlib, sys
groups = {k: v for k, v in json.load(open(sys.argv[1]))["dancedb"].items() if k in ("test", "validation")}
held = {name for names in groups.values() for name in names}
others = sorted((clip.stem for clip in pathlib.Path(sys.argv[2]).glob("*.clip") if clip.stem not in held),
                key=lambda name: hashlib.sha256(name.encode()).hexdigest())
groups["test_random"] = others[: round(len(others) / 5)]
json.dump({"dancedb": groups}, sys.stdout)
PYTHON
}

# The papers train for some 40 hours on a GPU at 1e-4; so few steps want a higher rate, and networks learn in parts. Paper F's by likelihood
# alone first (of a schedule of 4,500 steps the first 2,500), then with roll-outs, a step of which takes three times as long. Paper C's on
# transitions of up to 22 frames first (of a curriculum of 20,000 steps the first 5,000), then of 20 to 70 (of 4,500 steps the first 1,500), then
# the same until its rate has fallen; the real frames' share falls in each part.
f_first=${F_FIRST:-2500} f_steps=${F_STEPS:-1000} f_batch=${F_BATCH:-16}
c_first=${C_FIRST:-5000} c_second=${C_SECOND:-1500} c_steps=${C_STEPS:-800} c_batch=${C_BATCH:-32}

train() {  # train NAME STEPS OPTION...
  local folder=$run/$1 name=$1 steps=$2
  shift 2
  if [[ -f $folder/finished ]]; then
    echo "$folder is finished"
    return
  fi
  "$lab" train --name "$name" --run "$folder" --steps "$steps" --resume "$@"
  touch "$folder/finished"
}
flow() {  # flow NAME STEPS OPTION...
  local all=(--preset paper-f --data "$run/data/dancedb" "$run/data/tang61" --splits "$recordings/splits.json" --batch "$f_batch"
    --rate 0.001 --shortest 10 --longest 90 --device "${DEVICE:-cpu}" "${@:3}")
  train "$1-first" $((f_first * 9 / 5)) --stop-after "$f_first" --rollout-from "$f_first" "${all[@]}"
  train "$1" "$2" --from "$run/$1-first/checkpoint.safetensors" "${all[@]}"
}
controllers() {  # controllers NAME STEPS OPTION...
  local all=(--preset controllers-paper --data "$run/data/dancedb" --splits "$run/random_splits.json" --batch "$c_batch" --rate 0.001
    --longest 70 "${@:3}")
  # From 1 to a hundredth, as after 92,000 steps of the paper's 0.99995.
  decay() { awk -v n="$1" 'BEGIN { printf "%.6f", exp(log(0.01) / n) }'; }
  train "$1-first" $((4 * c_first)) --stop-after "$c_first" --truth-decay "$(decay $((4 * c_first)))" "${all[@]}"
  train "$1-second" $((3 * c_second)) --stop-after "$c_second" --from "$run/$1-first/checkpoint.safetensors" --shortest 20 \
    --truth-decay "$(decay $((3 * c_second)))" "${all[@]}"
  train "$1" "$2" --from "$run/$1-second/checkpoint.safetensors" --shortest 20 --truth-decay "$(decay "$2")" "${all[@]}"
}
one() {
  local f=${F_ABLATION_STEPS:-$f_steps} c=${C_ABLATION_STEPS:-$c_steps}
  case $1 in
    paper-f) flow paper-f "$f_steps" ;;
    f-full) flow f-full "$f" ;;
    f-no-key-loss) flow "$1" "$f" --no-key-loss ;;
    f-no-time-embedding) flow "$1" "$f" --no-time-embedding ;;
    f-forward-embedding) flow "$1" "$f" --forward-embedding ;;
    f-no-keys) flow "$1" "$f" --no-keys ;;
    paper-c) controllers paper-c "$c_steps" ;;
    c-full) controllers c-full "$c" ;;
    c-residual) controllers "$1" "$c" --residual ;;
    c-absolute) controllers "$1" "$c" --no-relative-position ;;
    c-relative) controllers "$1" "$c" --no-absolute-position ;;
    c-one-lstm) controllers "$1" "$c" --one-lstm ;;
    c-condition-fc) controllers "$1" "$c" --condition-fc ;;
    c-one-decoder) controllers "$1" "$c" --one-decoder ;;
    c-no-velocity-factors) controllers "$1" "$c" --no-velocity-factors ;;
    c-no-key-loss) controllers "$1" "$c" --no-key-loss ;;
    *) echo "train_papers.sh: there is no network '$1'; see the head of this file" >&2; exit 2 ;;
  esac
}

# Rows beside the judged network: the others that there are.
others=()
beside() {  # beside NAME FOLDER...
  local folder
  for folder in "${@:2}"; do
    [[ $folder == "$1" || ! -f $run/$folder/finished ]] || others+=(--other "$folder=$run/$folder/checkpoint.safetensors")
  done
}
measure() {  # measure NAME JSON OPTION...
  "$lab" eval --model "$run/$1/checkpoint.safetensors" --name "$1" --json "$run/$2.json" "${@:3}"
}
evaluate() {
  local shipped=(--other "default=$root/model/checkpoints/default.safetensors")
  others=()
  beside paper-f f-full f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys
  measure paper-f paper_f --paper --data "$run/data/dancedb" "$run/data/tang61" --splits "$recordings/splits.json" --split test \
    --lengths 30 60 90 --windows 6 --best-of 10 --long-dances 14 --long-frames 600 --baseline real interpolation \
    "${shipped[@]}" "${others[@]}"
  others=()
  beside paper-c c-full c-residual c-absolute c-relative c-one-lstm c-condition-fc c-one-decoder c-no-velocity-factors c-no-key-loss
  local c=(--controls paper --data "$run/data/dancedb" --splits "$run/random_splits.json" --windows 4 --no-encoder
    --baseline real interpolation "${others[@]}")
  # `default` learnt from the clips of the random fifth.
  measure paper-c paper_c_random "${c[@]}" --split test_random
  measure paper-c paper_c_unseen "${c[@]}" --split test "${shipped[@]}"
}

all=(paper-f paper-c f-full f-no-key-loss f-no-time-embedding f-forward-embedding f-no-keys c-full c-residual c-absolute c-relative
  c-one-lstm c-condition-fc c-one-decoder c-no-velocity-factors c-no-key-loss)
names=("$@")
((${#names[@]})) || names=(paper-f paper-c)
[[ ${names[*]} != all ]] || names=("${all[@]}")
case $task in
  prepare) prepare ;;
  train)
    prepare
    for name in "${names[@]}"; do one "$name"; done
    ;;
  eval) evaluate ;;
  everything)
    prepare
    for name in "${names[@]}"; do one "$name"; done
    evaluate
    ;;
  *) echo "train_papers.sh: '$task' is none of prepare, train, eval" >&2; exit 2 ;;
esac
