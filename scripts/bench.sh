#!/usr/bin/env bash
# Runs every benchmark program of a build.
#   scripts/bench.sh BIN_DIRECTORY
set -euo pipefail
shopt -s nullglob
for program in "$1"/*_bench; do
  "$program"
done
