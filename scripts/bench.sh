#!/usr/bin/env bash
# Runs the benchmarks of a build and writes docs/performance.md.
#   scripts/bench.sh BIN_DIRECTORY
# What was measured stays in a temporary folder if something fails.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
echo "measures into $folder"
how=(--benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true
  --benchmark_min_time=0.1)
"$1/engine_bench" --probes "$folder" "${how[@]}" --benchmark_out="$folder/engine.json"
"$1/engine_bench" --kernels avx2 "${how[@]}" --benchmark_filter='^default/' --benchmark_out="$folder/avx2.json"
/usr/bin/python3 "$root/bench/peer_torch.py" "$folder" >"$folder/peer.json"
if [[ -x $1/load ]]; then
  "$1/load" | tee "$folder/load.md"
  CHOREO_MAX_STREAMS=1024 "$1/load" --tables idle live --streams 50 100 200 250 300 --addresses 1 | tee "$folder/room.md"
  CHOREO_KERNELS=avx2 "$1/load" --tables live --streams 100 --addresses 1 | tee "$folder/avx2.md"
  # One worker, like the engine alone: two would share memory bandwidth. Eight dances want more than it has, so all are admitted.
  # Temperature 0: the random network moves faster than bodies do, so each transition would be sampled five times.
  CHOREO_WORKERS=1 CHOREO_MAX_LOAD=2 CHOREO_CHECKPOINT=$folder/paper.safetensors "$1/load" --tables closed --seconds 4 --temperature 0 | tee "$folder/paper.md"
fi
/usr/bin/python3 "$root/bench/report.py" "$folder" "$root"
rm -rf "$folder"
