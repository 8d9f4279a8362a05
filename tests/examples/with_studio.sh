#!/usr/bin/env bash
# Runs a command with $CHOREO_STUDIO naming a studio of the choreod that $CHOREO_SERVER names; the studio ends with the command.
#   with_studio.sh CHOREO COMMAND...
set -euo pipefail
exec 3< <(exec "$1" studio --listen 127.0.0.1:0 --server "$CHOREO_SERVER")
studio=$!
trap 'kill -INT "$studio"; wait "$studio" || true' EXIT
read -r line <&3 # "The studio is open at http://HOST:PORT  (Ctrl-C closes it)"
line=${line#*at }
export CHOREO_STUDIO=${line%% *}
"${@:2}"
