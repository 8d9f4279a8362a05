#!/usr/bin/env bash
# Has systemd judge docker/choreod.service.in: what it misspells, and what a broken choreod could do. Ends with 77 where it is not installed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
command -v systemd-analyze >/dev/null || { echo "systemd-analyze is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unit=$folder/choreod.service
# systemd wants a program that is there.
sed "s#@CMAKE_INSTALL_FULL_BINDIR@/choreod#$(command -v true)#" "$here/../../docker/choreod.service.in" > "$unit"
said=$(systemd-analyze verify --man=no "$unit" 2>&1 | grep -F "$unit" || true)
[ -z "$said" ] || { echo "$said"; exit 1; }
# In tenths, of at most 100: docs/deploy.md promises it.
systemd-analyze security --offline=yes --threshold=14 --no-pager "$unit" | tail -1
