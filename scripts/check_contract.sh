#!/usr/bin/env bash
# Checks that every test named in docs/contract.md is one that ctest knows, and every `make` target one of the Makefile.
#   scripts/check_contract.sh BUILD_DIRECTORY [REPORT [PAGE]]
# REPORT is what `ctest --output-junit` wrote: a name of tests that were all skipped is refused, too.
set -euo pipefail
page=$(realpath "${3:-$(dirname "$0")/../docs/contract.md}")
report=${2:+$(realpath "$2")}
cd "$(dirname "$0")/.."
known=$(ctest --test-dir "$1" -N | sed -n 's/  # GetParam.*//; s/^ *Test *#[0-9]*: //p')
skipped=$([[ -z $report ]] || grep -oE '<testcase name="[^"]*".* status="notrun"' "$report" | sed 's/  # GetParam[^"]*//; s/<testcase name="//; s/".*//' || true)
missing=0
count=0
# Names stand in backticks behind the first column of a table; a test's begins with a capital, or a * in its place, and has a dot.
while read -r name; do
  count=$((count + 1))
  if [[ $name == make\ * ]]; then
    grep -qE "^${name#make }:" Makefile && continue
    echo "$page: there is no $name" >&2
  else
    pattern=${name//./\\.}
    pattern=${pattern//\*/.*}
    matches=$(grep -xE "$pattern" <<<"$known" || true)
    if [[ -z $matches ]]; then
      echo "$page: there is no $name" >&2
    elif [[ -z $(grep -vxF -f <(echo "$skipped") <<<"$matches" || true) ]]; then
      echo "$page: $name was skipped" >&2
    else
      continue
    fi
  fi
  missing=1
done < <(sed -n 's/^|[^|]*|\(.*\)|$/\1/p' "$page" | grep -oE '`([A-Z*][^` ]*\.[^` ]*|make [a-z]+)`' | tr -d '`')
if ((count == 0)); then
  echo "$page: names no test" >&2
  exit 1
fi
echo "$count names looked up"
exit "$missing"
