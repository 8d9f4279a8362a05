#include "client/cli/options/bone_map.h"

#include "model/fit/bones/find_bones.h"
#include "model/motion/skeleton.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

// A map, and what it makes of a rig: SMPL's, of which two nodes have one name and one has none.
FUZZ_TARGET(bone_map) {
  using namespace choreo;
  static const fuzz::InputFile input(".json");
  static const RigNodes rig = [] {
    const Skeleton& smpl = Skeleton::Smpl24();
    const auto count = static_cast<size_t>(smpl.joints());
    RigNodes nodes{.names = smpl.joint_names,
                   .parents = smpl.parents,
                   .places = smpl.offsets,
                   .joints = std::vector<bool>(count, true),
                   .moves = std::vector<bool>(count, true),
                   .meshes = std::vector<bool>(count)};
    nodes.names[count - 1] = nodes.names[count - 2];
    nodes.names[3].clear();
    return nodes;
  }();
  fuzz::MayRefuse([&] {
    const HumanBones found =
        FindBones(rig, cli::ReadBoneMap(input.Holding(fuzz::Text(data, size))));
    for (const auto& [bone, node] : found.bones)
      if (node < 0 || node >= static_cast<int>(rig.names.size()))
        fuzz::Fail("a bone that is no node");
  });
  return 0;
}
