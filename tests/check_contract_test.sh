#!/usr/bin/env bash
# scripts/check_contract.sh takes names of tests that ran, and refuses those of tests that are gone or were skipped.
set -euo pipefail
check=$(realpath "$(dirname "$0")/../scripts/check_contract.sh")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
cat >CTestTestfile.cmake <<'END'
add_test(Dance.Ends true)
add_test(Dance.Begins/0 true)
foreach(skipped Dance.Begins/1 Golden.Fits)
  add_test(${skipped} sh -c "exit 77")
  set_tests_properties(${skipped} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
END
ctest --output-junit report.xml >/dev/null
says() {  # says TEXT NAME: of a page with this name
  echo "| a promise | \`$2\` |" >page.md
  local said
  said=$("$check" "$scratch" report.xml page.md 2>&1) || true
  [[ $said == *"$1"* ]] || { echo "of $2: '$said', not '$1'" >&2; exit 1; }
}
says "1 names looked up" Dance.Ends
says "1 names looked up" 'Dance.Begins*'
says "Golden.Fits was skipped" Golden.Fits
says "Dance.Begins/1 was skipped" Dance.Begins/1
says "there is no Dance.Rests" Dance.Rests
if "$check" "$scratch" report.xml page.md >/dev/null 2>&1; then exit 1; fi
