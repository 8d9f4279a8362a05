#!/usr/bin/env bash
# Installs what client/node, examples/node and clients of their own kind need, as their users do, and runs the tests of all. Ends with 77, which skips the test, where
# that cannot be had.
#   node_test.sh CHOREOD CHOREO WRITE_CHARACTERS
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
for folder in client/node examples/node tests/examples/es tests/proto/buf; do "$tests/../support/npm_ci.sh" "$tests/../../$folder"; done
export CHOREO=$2 WRITE_CHARACTERS=$3
"$tests/with_server.sh" "$1" node --test "$tests"/node*.test.mjs
