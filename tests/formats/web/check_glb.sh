#!/usr/bin/env bash
# Runs check_glb.mjs; ends with 77 where what it needs cannot be had.
#   check_glb.sh FILE.glb EXPECTED.json
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/../../support/npm_ci.sh" "$here"
node "$here/check_glb.mjs" "$@"
