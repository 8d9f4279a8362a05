#!/usr/bin/env bash
# Builds docker/Dockerfile without a container engine, runs the image, and dances with it. Needs root. Its storage stays in
# BUILD_DIRECTORY/container, so that a second build is quick.
#   scripts/verify_container.sh BUILD_DIRECTORY
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
choreo=$(realpath "$1")/bin/choreo
storage=$(realpath "$1")/container
if [[ $(id -u) -ne 0 ]]; then
  echo "verify_container.sh: needs root, for debootstrap and chroot" >&2
  exit 1
fi
"$root/scripts/install_packages.sh" verify demo
mkdir -p "$storage"
build() { buildah --root "$storage/images" --runroot "$storage/run" "$@"; }
inside() { build run --isolation chroot --network host "$@"; }

scratch=$(mktemp -d)
container=
server=
finish() {
  if [[ -n $server ]]; then kill "$server" 2>/dev/null || true; fi
  if [[ -n $container ]]; then build rm "$container" >/dev/null; fi
  rm -rf "$scratch"
  # buildah leaves it mounted, which would make `rm -r build` fail.
  umount "$storage/images/overlay" 2>/dev/null || true
}
trap finish EXIT

# The base image, made here: Debian's own installer unpacks the same packages.
if ! build images -q debian:bookworm-slim >/dev/null 2>&1; then
  debootstrap --variant=minbase bookworm "$scratch/debian" >"$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
  # As in the slim image, packages are installed without manuals.
  printf 'path-exclude %s\n' '/usr/share/doc/*' '/usr/share/man/*' '/usr/share/locale/*' >"$scratch/debian/etc/dpkg/dpkg.cfg.d/slim"
  base=$(build from scratch)
  build add -q "$base" "$scratch/debian" / >/dev/null
  build commit -q "$base" debian:bookworm-slim >/dev/null
  build rm "$base" >/dev/null
fi
# Only docker's format has health checks.
build bud --layers --format docker --isolation chroot --network host --pull-never --build-arg "JOBS=${JOBS:-$(nproc)}" \
  -f "$root/docker/Dockerfile" -t choreo "$root"
build images choreo
container=$(build from choreo)

expect() { # what, command...
  if ! "${@:2}"; then
    echo "verify_container.sh: $1" >&2
    exit 1
  fi
  echo "ok: $1"
}
expect "it does not run as root" inside "$container" -- sh -c '[ "$(id -u)" -ne 0 ]'
expect "it has no compiler" inside "$container" -- sh -c '! command -v g++ cc ninja'
expect "all shared libraries are there" inside "$container" -- \
  sh -c '! ldd /usr/local/bin/choreod /usr/local/bin/choreo | grep "not found"'

expect "it does not listen to everybody without TLS" inside "$container" -- sh -c '! choreod 2>/dev/null'

# With the image's user, environment and entry point, but on our own port.
entry=$(build inspect --format '{{index .Docker.Config.Entrypoint 0}}' "$container")
port=$((20000 + RANDOM % 20000))
settings=(--env "CHOREO_LISTEN=127.0.0.1:$port")
inside "${settings[@]}" "$container" -- sh -c "echo \$\$; exec $entry" >"$scratch/said" 2>"$scratch/log" &
runner=$!
until grep -q "listens on" "$scratch/said"; do
  if ! kill -0 "$runner" 2>/dev/null; then
    cat "$scratch/said" "$scratch/log" >&2
    exit 1
  fi
  sleep 0.2
done
server=$(head -1 "$scratch/said")

health=$(build inspect --format '{{index .Docker.Config.Healthcheck.Test 1}}' "$container")
expect "its health check passes" inside "${settings[@]}" "$container" -- sh -c "$health"
song="/usr/share/games/fretsonfire/data/songs/sectoid/Escape from chaosland/song.ogg"
expect "a client dances" "$choreo" dance "$song" --server "127.0.0.1:$port" --seconds 6 --seed 1 --out "$scratch/dance.npz"
kill "$server"
expect "it leaves when asked to" wait "$runner"
server=
expect "its health check fails then" inside "${settings[@]}" "$container" -- sh -c "! ( $health )"
