#!/usr/bin/env bash
# Runs libFuzzer on every target of tests/fuzz for SECONDS each, one per core at a time, and prints executions, covered edges, and
# finds. A find stays in out/fuzz/TARGET/: fix it, and add it to tests/fuzz/corpus/TARGET. Runs all targets, or those given.
#   cmake --preset fuzz && cmake --build build/fuzz --target choreo_fuzz
#   scripts/fuzz.sh build/fuzz SECONDS [TARGET...]
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
bin=$(realpath "$1")/bin
seconds=$2
shift 2
if (($# == 0)); then
  targets=("$bin"/fuzz_*)
  set -- "${targets[@]##*/fuzz_}"
fi

fuzz() {
  local target=$1 leaks=1 lengths=(-max_len=8192)
  # The server's threads free a call's memory slightly later; libsndfile leaks 6 KB for some damaged Oggs.
  [[ ! $target =~ ^(stream_dance|generate_transition|audio)$ ]] || leaks=0
  # Calls are slow: libFuzzer would reach only a few messages. 256 bytes are a hundred.
  [[ ! $target =~ ^(stream_dance|generate_transition)$ ]] || lengths=(-max_len=256 -len_control=0)
  local out=$root/out/fuzz/$target found=none
  mkdir -p "$out/corpus"
  (cd "$out" && ASAN_OPTIONS=detect_leaks=$leaks "$bin/fuzz_$target" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2048 -malloc_limit_mb=1024 "${lengths[@]}" \
    -detect_leaks=$leaks -print_final_stats=1 corpus "$root/tests/fuzz/corpus/$target") >"$out/log" 2>&1 || found="see $out/log"
  local executions edges
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$out/log")
  edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$out/log" | tail -1)
  printf '%-20s %12s executions %6s edges   found: %s\n' "$target" "${executions:-?}" "${edges:-?}" "$found"
  [[ $found == none ]]
}
export -f fuzz
export bin root seconds
printf '%s\n' "$@" | xargs -P "${JOBS:-$(env -u OMP_NUM_THREADS nproc)}" -I TARGET nice -n 5 bash -c 'fuzz TARGET'
