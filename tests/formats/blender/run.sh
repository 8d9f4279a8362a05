#!/usr/bin/env bash
# Opens our BVH and glTF files, and characters that dance, in Blender, and reads what Blender writes. Ends with 77 where there is none.
#   run.sh BUILD_DIRECTORY
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../../support/blender.sh" "$1"
dance=$scratch/dance.glb
"$here/../../examples/with_server.sh" "$bin/fake_choreod" sh -c \
  '"$0" dance --server "$CHOREO_SERVER" --keyframes "$1" --seconds 2 --out "$2" >/dev/null' \
  "$bin/choreo" "$here/keys.json" "$dance"
for names in smpl mixamo humanik ue; do
  for unit in m cm; do "$bin/choreo" convert "$dance" "$scratch/$names-$unit.bvh" --names $names --unit $unit; done
done
blender -b --factory-startup --python-exit-code 1 -P "$here/check_bvh.py" -- "$scratch" | grep -v '^$'

"$bin/choreo" convert "$dance" "$scratch/dance.npz"
blender -b --factory-startup --python-exit-code 1 -P "$here/check_npz.py" -- "$scratch" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
grep ^ok: "$scratch/log"
for kind in bvh glb; do "$bin/choreo" convert "$scratch/blender.$kind" "$scratch/blender-$kind.npz"; done
python3 "$here/same_dance.py" "$scratch/dance.npz" "$scratch/blender-bvh.npz" "$scratch/blender-glb.npz"

"$bin/write_characters" "$scratch"
blender -b --factory-startup --python-exit-code 1 -P "$here/metarigs.py" -- "$scratch" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
for name in mixamo child long basic human; do
  "$bin/choreo" convert "$dance" "$scratch/$name-dances.glb" --character "$scratch/$name.glb"
done
blender -b --factory-startup --python-exit-code 1 -P "$here/check_characters.py" -- "$scratch" | grep -v '^$'
