#include "model/formats/skeleton_npz.h"

#include "model/formats/own_arrays.h"
#include "model/motion/skeleton_json.h"

namespace choreo {

bool HasSkeletonMotion(const NpzArchive& npz) { return npz.Has("skeleton"); }

SkeletonMotion ReadSkeletonMotion(const NpzArchive& npz) {
  const Skeleton skeleton = SkeletonFromJson(npz.Text("skeleton"));
  return {skeleton, ReadOwnArrays(skeleton, npz)};
}

void AddSkeletonMotion(const Skeleton& skeleton, const Motion& motion,
                       const std::vector<Contacts>* contacts, NpzArchive& npz) {
  AddOwnArrays(skeleton, motion, contacts, npz);
  npz.SetText("skeleton", SkeletonToJson(skeleton));
}

}  // namespace choreo
