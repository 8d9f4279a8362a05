#!/usr/bin/env bash
# Runs every test in a build directory and ends with one line: "N passed, N failed, N skipped".
#   scripts/run_tests.sh BUILD_DIRECTORY
set -euo pipefail
build=$1
report=$(mktemp)
trap 'rm -f "$report"' EXIT

# One more test than cores, or twice as many of those that mostly wait: others count as two processors (choreo_test). Each gets one BLAS
# thread: ctest already uses every core. (nproc comes first because it obeys OMP_NUM_THREADS.)
jobs=$((2 * ($(env -u OMP_NUM_THREADS nproc) + 1)))
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
root=$(cd "$(dirname "$0")/.." && pwd)
export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp ${TSAN_OPTIONS:-}"
# Processes of this build's programs, one per line.
running() { find /proc -maxdepth 2 -name exe -lname "$(realpath "$build")/*" 2>/dev/null | cut -d/ -f3 | sort || true; }
before=$(running)
rc=0
run=(ctest --test-dir "$build" --output-on-failure -j "$jobs" --no-tests=error --output-junit "$report")
if [[ -t 1 ]]; then
  "${run[@]}" --progress || rc=$?
else
  # A log needs no lines for passing tests.
  "${run[@]}" | grep -vE '^ +Start +[0-9]+: |   Passed  ' || rc=${PIPESTATUS[0]}
fi

# The first line with these attributes is the <testsuite>, with the totals.
attribute() { grep -oE -m1 "$1=\"[0-9]+\"" "$report" | head -1 | tr -dc 0-9 || true; }
total=$(attribute tests)
failed=$(attribute failures)
skipped=$(($(attribute skipped) + $(attribute disabled)))
if [[ -z $total ]]; then
  echo "run_tests.sh: ctest wrote no report" >&2
  exit 1
fi
# No promise may rest on a skipped test. (Not checked under sanitizers, which skip some.)
if grep -q 'name="Contract.NamesTestsThatExist"' "$report"; then
  "$(dirname "$0")/check_contract.sh" "$(realpath "$build")" "$report" >/dev/null || rc=1
fi
# No process may outlive the tests; a stopping one gets a moment. Earlier processes are not theirs.
for _ in {1..50}; do
  left=$(comm -13 <(echo "$before") <(running))
  [[ -z $left ]] && break
  sleep 0.2
done
for process in $left; do
  echo "run_tests.sh: left behind: $process $(tr '\0' ' ' <"/proc/$process/cmdline" 2>/dev/null)" >&2
  kill "$process" 2>/dev/null || true
  rc=1
done
echo "$((total - failed - skipped)) passed, $failed failed, $skipped skipped"
exit "$rc"
