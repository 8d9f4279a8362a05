#!/usr/bin/env bash
# Runs manifests_test.mjs. Ends with 77 where its packages cannot be had.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/../support/npm_ci.sh" "$here"
node --test "$here/manifests_test.mjs"
