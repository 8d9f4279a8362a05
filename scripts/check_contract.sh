#!/usr/bin/env bash
# Checks that every test named in docs/contract.md is one that ctest knows, and every `make` target one of the Makefile.
#   scripts/check_contract.sh BUILD_DIRECTORY
set -euo pipefail
cd "$(dirname "$0")/.."
known=$(ctest --test-dir "$1" -N | sed -n 's/  # GetParam.*//; s/^ *Test *#[0-9]*: //p')
missing=0
count=0
# Names stand in backticks in the last column of a table; a test's begins with a capital, or a * in its place, and has a dot.
while read -r name; do
  count=$((count + 1))
  if [[ $name == make\ * ]]; then
    grep -qE "^${name#make }:" Makefile && continue
  else
    pattern=${name//./\\.}
    grep -qxE "${pattern//\*/.*}" <<<"$known" && continue
  fi
  echo "docs/contract.md: there is no $name" >&2
  missing=1
done < <(sed -n 's/^|.*|\(.*\)|$/\1/p' docs/contract.md | grep -oE '`([A-Z*][^` ]*\.[^` ]*|make [a-z]+)`' | tr -d '`')
if ((count == 0)); then
  echo "docs/contract.md: names no test" >&2
  exit 1
fi
echo "$count names looked up"
exit "$missing"
