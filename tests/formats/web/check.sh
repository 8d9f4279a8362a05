#!/usr/bin/env bash
# Runs one of the checks beside it; ends with 77 where what it needs cannot be had.
#   check.sh check_glb.mjs FILE.glb EXPECTED.json
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/../../support/npm_ci.sh" "$here"
node "$here/$1" "${@:2}"
