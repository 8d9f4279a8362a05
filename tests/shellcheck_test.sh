#!/usr/bin/env bash
# Checks all shell scripts with shellcheck. Ends with 77, which skips the test, where it is not installed.
set -euo pipefail
command -v shellcheck >/dev/null || { echo "shellcheck is not installed (scripts/install_packages.sh test)"; exit 77; }
cd "$(dirname "$0")/.."
mapfile -t scripts < <(find . \( -name node_modules -o -name build -o -name out \) -prune -o -name '*.sh' -print | sort)
# SC2016: programs that another shell runs stand in single quotes, so that this one expands nothing.
shellcheck -x -P SCRIPTDIR -e SC2016 "${scripts[@]}"
echo "${#scripts[@]} scripts are fine"
