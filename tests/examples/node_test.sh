#!/usr/bin/env bash
# Installs what examples/node needs, as its users do, and runs the tests of it. Ends with 77, which skips the test, where that cannot be had.
#   node_test.sh CHOREOD
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
"$tests/../support/npm_ci.sh" "$tests/../../examples/node"
"$tests/with_server.sh" "$1" node --test "$tests/node.test.mjs"
