#!/usr/bin/env bash
# Builds the page as it is committed, and uses the studio in a headless Chromium: all of it, then
# the timeline, faults, phrases, several dancers, beats, takes, poses, photos, the floor path, live mode, a phone, films.
#   run.sh BUILD_DIRECTORY [PICTURES_FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
page=$here/../../../studio/page
build=$(realpath "$1")
CHOREO_SKIP_CODE=1 "$here/../../support/npm_ci.sh" "$page"
"$here/check_page.sh" "$page"
scripts=$here/../../../scripts
"$scripts/photo_model.sh" "$build/share/choreo/photo"
for test in studio timeline faults phrases company beats takes pose photo path live phone film; do
  echo "-- $test"
  node "$here/$test.test.mjs" "$build/bin/choreo" "${2:-$build/studio_pictures}"
done
