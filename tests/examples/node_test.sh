#!/usr/bin/env bash
# Installs what client/node, examples/node and clients of their own kind need, as their users do, and runs the tests whose files begin with a word.
# Ends with 77, which skips them, where that cannot be had.
#   node_test.sh WORD CHOREOD CHOREO WRITE_CHARACTERS
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
for folder in client/node examples/node tests/examples/es tests/proto/buf; do "$tests/../support/npm_ci.sh" "$tests/../../$folder"; done
export CHOREO=$3 WRITE_CHARACTERS=$4
"$tests/with_server.sh" "$2" node --test "$tests/$1"*.test.mjs
