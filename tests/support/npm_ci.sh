#!/usr/bin/env bash
# Installs what a folder's package-lock.json names into its node_modules, where that has not been done. Ends with 77, which skips a test,
# where there is no npm or it reaches no registry; whatever else goes wrong fails.
#   npm_ci.sh FOLDER
set -euo pipefail
cd "$1"
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "skipped: there is no Node.js with npm here (scripts/install_packages.sh test)"
  exit "${CHOREO_SKIP_CODE:-77}"
fi

# Several builds may be tested at once.
exec 9<package-lock.json
flock 9
[[ node_modules/.package-lock.json -nt package-lock.json ]] && exit 0
log=$(mktemp)
trap 'rm -f "$log"' EXIT
npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 >"$log" 2>&1 && exit 0
cat "$log"
if grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|EHOSTUNREACH|ENETUNREACH|ETIMEDOUT|ERR_SOCKET_TIMEOUT' "$log"; then
  echo "skipped: npm reaches no registry"
  exit "${CHOREO_SKIP_CODE:-77}"
fi
exit 1
