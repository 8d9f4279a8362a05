#!/usr/bin/env bash
# What the studio's page reckons by itself. Ends with 77, which skips a test, where npm_ci.sh does.
#   page_logic_test.sh
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
page=$here/../../studio/page
"$here/../support/npm_ci.sh" "$page"
mkdir -p "$page/src/generated"
npm --prefix "$page" run --silent generate
node --test "$here/browser/logic.test.mjs"
