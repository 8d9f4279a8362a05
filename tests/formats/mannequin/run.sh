#!/usr/bin/env bash
# Puts a dance on npm's mannequin (VRM's names, a compressed mesh). Ends with 77 where what it needs cannot be had.
#   run.sh BUILD_DIRECTORY
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
bin=$(realpath "$1")/bin
"$here/../../support/npm_ci.sh" "$here"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$here/../../examples/with_server.sh" "$bin/fake_choreod" sh -c \
  '"$0" dance --server "$CHOREO_SERVER" --keyframes "$1" --seconds 2 --out "$2" >/dev/null' \
  "$bin/choreo" "$here/../blender/keys.json" "$scratch/dance.glb"
node "$here/unpack.mjs" "$scratch/mannequin.glb"
"$bin/choreo" convert "$scratch/dance.glb" "$scratch/dances.glb" --character "$scratch/mannequin.glb"
node "$here/check.mjs" "$scratch/dance.glb" "$scratch/mannequin.glb" "$scratch/dances.glb"
