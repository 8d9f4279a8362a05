#!/usr/bin/env bash
# What is too long for `make test`: the figures of docs/results.md, a stranger's program that uses the installed client, the container, a
# build without the service, and the tests under sanitizers.
# CHOREO_RECORDINGS names the folder of recordings that figures are measured on (scripts/evaluate.sh); without it they are left out.
#   scripts/verify.sh BUILD_DIRECTORY
set -euo pipefail
build=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$root"

echo "== The figures of docs/results.md"
if [[ -n ${CHOREO_RECORDINGS:-} ]]; then
  scripts/evaluate.sh "$build/bin" "$CHOREO_RECORDINGS"
  git diff --stat -- docs
else
  echo "left out: CHOREO_RECORDINGS names no folder of recordings"
fi

echo "== The installed package serves a stranger"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
cmake -S "$root/examples/client" -B "$scratch/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/consumer"
"$scratch/prefix/bin/choreo" --version
# Nobody listens on port 1: that it says so shows that the program runs.
if "$scratch/consumer/first_dance" 127.0.0.1:1 2>"$scratch/said"; then
  echo "verify.sh: first_dance should have failed without a server" >&2
  exit 1
fi
grep -q "127.0.0.1:1" "$scratch/said"

echo "== The container builds and dances"
"$root/scripts/verify_container.sh" "$build"

echo "== Without the service: the model, choreo-lab, and their tests"
cmake --preset release -B build/model -DCHOREO_SERVICE=OFF >/dev/null
cmake --build build/model -j "$(nproc)"
scripts/run_tests.sh build/model

for preset in asan tsan; do
  echo "== Tests under $preset"
  cmake --preset "$preset" >/dev/null
  # Not the programs: they run LibTorch, which is not built for sanitizers and left out of these tests.
  cmake --build "build/$preset" -j "$(nproc)" --target choreo_tests
  scripts/run_tests.sh "build/$preset"
done
