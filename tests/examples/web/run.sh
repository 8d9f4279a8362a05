#!/usr/bin/env bash
# Uses the page of examples/web in a headless Chromium, with a server with a fake engine. Ends with 77 where what it needs cannot be had.
#   run.sh BUILD_DIRECTORY [PICTURES_FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
bin=$(realpath "$1")/bin
for folder in client/node examples/node examples/web studio/page; do "$root/tests/support/npm_ci.sh" "$root/$folder"; done
pictures=${2:-$(realpath "$1")/web_pictures}
mkdir -p "$pictures"
"$bin/write_characters" "$pictures"
CHOREOD=$bin/fake_choreod PICTURES=$pictures node --test "$here/page.test.mjs"
