#!/usr/bin/env bash
# Uses the add-on of examples/blender in a Blender without a window. Ends with 77 where there is no Blender.
#   run.sh BUILD_DIRECTORY
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../../support/blender.sh" "$1"
(cd "$here/../../../examples/blender" && python3 -m zipfile -c "$scratch/choreo.zip" choreo)
python3 - "$scratch/song.wav" <<'PYTHON'
import math, struct, sys, wave
with wave.open(sys.argv[1], "wb") as out:
    out.setparams((1, 2, 22050, 0, "NONE", ""))
    clicks = (20000 * math.exp(-(i % 11025) / 200) * math.sin(i % 11025 / 2) for i in range(6 * 22050))
    out.writeframes(b"".join(struct.pack("<h", int(value)) for value in clicks))
PYTHON
export BLENDER_USER_SCRIPTS=$scratch/scripts BLENDER_USER_CONFIG=$scratch/config
mkdir "$scratch/scripts" "$scratch/config"
"$here/../with_server.sh" "$bin/fake_choreod" "$here/../with_studio.sh" "$bin/choreo" \
  blender -b --factory-startup --python-exit-code 1 -P "$here/addon_test.py" -- "$scratch/choreo.zip" "$scratch/song.wav"
