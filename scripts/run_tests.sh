#!/usr/bin/env bash
# Runs every test in a build directory and ends with one line: "N passed, N failed, N skipped".
#   scripts/run_tests.sh BUILD_DIRECTORY
set -euo pipefail
shopt -s nullglob
build=$1
report=$(mktemp)
cases=$(mktemp)
trap 'rm -f "$report" "$cases"' EXIT

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
# Cases of programs that don't wait share processes (choreo_test).
together=$build/Testing/together
rm -rf "$together"
run=(ctest --test-dir "$build" -C together -LE alone --output-on-failure -j "$jobs" --no-tests=error --output-junit "$report")
if [[ -t 1 ]]; then
  "${run[@]}" --progress || rc=$?
else
  # A log needs no lines for passing tests.
  "${run[@]}" | grep -vE '^ +Start +[0-9]+: |   Passed  ' || rc=${PIPESTATUS[0]}
fi

# A line for each case, as in ctest's report. Cases that shared a process are in its own; without one it has crashed, and counts as a case.
awk -v together="$together" '
  function attribute(name) { return match($0, " " name "=\"[^\"]*") ? substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : "" }
  function tell() { if (test != "") print "<testcase name=\"" test "\" status=\"" status "\"/>"; test = "" }
  !/<testcase |<failure / { next }
  FILENAME == ARGV[1] && /<testcase / {
    tell()
    test = attribute("name"); status = attribute("status")
    if ((getline line <(together "/" test ".xml")) > 0) test = ""
    next
  }
  /<testcase / {
    tell()
    test = attribute("classname") "." attribute("name")
    status = attribute("status") == "notrun" ? "disabled" : attribute("result") == "skipped" ? "notrun" : "run"
  }
  FILENAME != ARGV[1] && /<failure / { status = "fail" }
  END { tell() }
' "$report" "$together"/*.xml >"$cases"
count() { grep -cE "status=\"($1)\"" "$cases" || true; }
total=$(count '.*')
failed=$(count fail)
skipped=$(count 'notrun|disabled')
if [[ $total == 0 ]]; then
  echo "run_tests.sh: ctest wrote no report" >&2
  exit 1
fi
sed -n 's/<testcase name="\(.*\)" status="fail".*/failed: \1/p' "$cases" >&2
# No promise may rest on a skipped test. (Not checked under sanitizers, which skip some.)
if grep -q 'name="Contract.NamesTestsThatExist"' "$cases"; then
  "$(dirname "$0")/check_contract.sh" "$(realpath "$build")" "$cases" >/dev/null || rc=1
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
