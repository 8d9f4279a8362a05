#!/usr/bin/env bash
# Runs a command with $CHOREO_SERVER naming a choreod of its own, which ends with it, and $CHOREOD the program.
#   with_server.sh CHOREOD COMMAND...
# $SERVED names the models that it serves, where not those for every day.
set -euo pipefail
export CHOREOD=$1
exec 3< <(exec "$1" --listen 127.0.0.1:0 ${SERVED:+--model $SERVED})
server=$!
trap 'kill "$server"; wait "$server" || true' EXIT
until [[ ${line:-} == *"listens on "* ]]; do read -r line <&3; done # "choreod listens on HOST:PORT", after what it logs
export CHOREO_SERVER=${line##* }
"${@:2}"
