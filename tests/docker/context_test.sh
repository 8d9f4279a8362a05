#!/usr/bin/env bash
# Configures what docker/Dockerfile builds from nothing but the files that .dockerignore lets into its context, and looks for missing inputs.
# Docker itself is needed by `make verify` alone.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$root"
mapfile -t allowed < <(sed -n 's/^!//p' .dockerignore)
mkdir "$folder/context"
tar -cf - --exclude=node_modules "${allowed[@]}" | tar -xf - -C "$folder/context"
configure=$(grep -o 'cmake -S \. -B /build .*' docker/Dockerfile)
cd "$folder/context"
eval "${configure/-B \/build/-B "$folder/build"}" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
ninja -C "$folder/build" -n choreod choreo >"$folder/log" || { tail "$folder/log"; exit 1; }
# `cmake --install` wants files that no target makes.
/usr/bin/python3 - "$folder/build" "$folder/context" <<'PYTHON'
import pathlib, re, sys
build, context = sys.argv[1:]
missing = {name for script in pathlib.Path(build).rglob("cmake_install.cmake")
           for name in re.findall(r'"(' + re.escape(context) + r'/[^"]*)"', script.read_text()) if not pathlib.Path(name).exists()}
sys.exit("\n".join(sorted(missing)) if missing else 0)
PYTHON
