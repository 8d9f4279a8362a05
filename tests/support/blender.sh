# shellcheck shell=bash disable=SC2034  # whoever sources it uses bin
# Sourced by tests that use Blender, with the build directory as $1: sets bin and scratch, a folder that goes with the test. Ends the test with
# 77 where there is no Blender.
bin=$(realpath "$1")/bin
if ! command -v blender >/dev/null; then
  echo "skipped: there is no Blender here (scripts/install_packages.sh blender)"
  exit "${CHOREO_SKIP_CODE:-77}"
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
