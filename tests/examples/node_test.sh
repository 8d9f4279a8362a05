#!/usr/bin/env bash
# Installs what examples/node needs, as its users do, and runs the tests of it. Ends with 77, which skips the test, where npm reaches no
# registry; whatever else goes wrong fails.
#   node_test.sh CHOREOD
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
cd "$tests/../../examples/node"
if ! command -v node npm >/dev/null; then
  echo "skipped: there is no Node.js with npm here (scripts/install_packages.sh test)"
  exit 77
fi

# Several builds may be tested at once.
exec 9<package-lock.json
flock 9
if [[ ! node_modules/.package-lock.json -nt package-lock.json ]]; then
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  if ! npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 >"$log" 2>&1; then
    cat "$log"
    if grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|EHOSTUNREACH|ENETUNREACH|ETIMEDOUT|ERR_SOCKET_TIMEOUT' "$log"; then
      echo "skipped: npm reaches no registry"
      exit 77
    fi
    exit 1
  fi
fi
flock -u 9

"$tests/with_server.sh" "$1" node --test "$tests/node.test.mjs"
