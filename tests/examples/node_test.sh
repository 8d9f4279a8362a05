#!/usr/bin/env bash
# Installs what client/node and examples/node need, as their users do, and runs the tests of both. Ends with 77, which skips the test, where
# that cannot be had.
#   node_test.sh CHOREOD
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
for folder in client/node examples/node; do "$tests/../support/npm_ci.sh" "$tests/../../$folder"; done
"$tests/with_server.sh" "$1" node --test "$tests"/node*.test.mjs
