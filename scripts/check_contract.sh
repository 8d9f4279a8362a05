#!/usr/bin/env bash
# Checks that ctest knows every test named in docs/contract/, and the Makefile every `make` target.
#   scripts/check_contract.sh BUILD_DIRECTORY [REPORT [PAGE...]]
# REPORT is the output of `ctest --output-junit`: a name whose tests were all skipped is refused, too.
set -euo pipefail
pages=("${@:3}")
((${#pages[@]})) || pages=("$(dirname "$0")"/../docs/contract/*.md)
mapfile -t pages < <(realpath "${pages[@]}")
build=$1
report=${2:+$(realpath "$2")}
cd "$(dirname "$0")/.."
tests() { ctest --test-dir "$1" -N | sed -n 's/  # GetParam.*//; s/^ *Test *#[0-9]*: //p'; }
targets() { sed -nE 's/^([a-z]+):.*/make \1/p' Makefile; }
skipped() { [[ -z $report ]] || grep -oE '<testcase name="[^"]*".* status="notrun"' "$report" | sed 's/  # GetParam[^"]*//; s/<testcase name="//; s/".*//'; }
# Names are in backticks after the first column of a table; a test's begins with a capital or a * and has a dot.
names() { sed -n 's/^|[^|]*|\(.*\)|$/\1/p' "$1" | grep -oE '`([A-Z*][^` ]*\.[^` ]*|make [a-z]+)`' | tr -d '`'; }
check() {
  awk -v page="$1" '
    FILENAME == ARGV[1] { ran[$0] = 1; next }
    FILENAME == ARGV[2] { delete ran[$0]; skipped[$0] = 1; next }
    { ++count }
    $0 in ran { next }
    {
      pattern = "^" $0 "$"
      gsub(/\./, "[.]", pattern)
      gsub(/\*/, ".*", pattern)
      for (test in ran) if (test ~ pattern) next
      why = "there is no " $0
      for (test in skipped) if (test ~ pattern) why = $0 " was skipped"
      print page ": " why >"/dev/stderr"
      missing = 1
    }
    END {
      if (!count) { print page ": names no test" >"/dev/stderr"; exit 1 }
      print page ": " count " names looked up"
      exit missing
    }' "$scratch/ran" "$scratch/skipped" <(names "$1")
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(tests "$build"; targets) >"$scratch/ran"
skipped >"$scratch/skipped" || true  # there may be none
rc=0
for page in "${pages[@]}"; do check "$page" || rc=1; done
exit "$rc"
