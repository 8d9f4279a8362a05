#!/usr/bin/env bash
# Fails where the page in studio/page/dist is not what its sources build.
#   check_page.sh PAGE_FOLDER
set -euo pipefail
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -r dist "$scratch/dist"
npm run --silent build >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
diff -rq "$scratch/dist" dist || {
  echo "check_page.sh: studio/page/dist was not built from these sources; commit what \`npm run build\` made of them" >&2
  exit 1
}
