#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "model/body/skin.h"
#include "model/formats/gltf.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace choreo::gltf_web_test {

using nlohmann::json;

const Skeleton& kSmpl = Skeleton::Smpl24();

json Numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Where joints and a few of the skin's vertices are, by our own kinematics.
json Expected(const Motion& motion, size_t frame) {
  const JointPlacement rest = ForwardKinematics(kSmpl, RestPose(kSmpl));
  const JointPlacement now = ForwardKinematics(kSmpl, motion.frames[frame]);
  json out = {{"time", static_cast<double>(frame) / motion.fps}};
  for (int joint = 0; joint < kSmpl.joints(); ++joint)
    out["joints"][kSmpl.joint_names[joint]] = Numbers(now.positions.col(joint));
  for (const SkinPatch& patch : MakeSkin(kSmpl)) {
    const char* material = patch.colour == kLeftColour    ? "left"
                           : patch.colour == kRightColour ? "right"
                           : patch.colour == kSkinColour  ? "skin"
                           : patch.colour == kHairColour  ? "hair"
                                                          : "trunk";
    for (size_t v = 0; v < patch.positions.size(); v += 97) {
      const int joint = patch.joints[v];
      const Eigen::Vector3d in_joint =
          patch.positions[v].cast<double>() - rest.positions.col(joint);
      out["skin"][material][std::to_string(v)] =
          Numbers(now.positions.col(joint) + now.rotations[joint] * in_joint);
    }
  }
  return out;
}

TEST(GltfWeb, KhronosAndThreeJsAgreeWithUs) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 50, 30);
  WriteGlb(folder / "a.glb", kSmpl, motion);
  json expected = {{"duration", 49.0 / 30}};
  // The last frame is left out: three.js starts over there.
  for (const size_t frame : {0, 1, 17, 48}) expected["frames"].push_back(Expected(motion, frame));
  std::ofstream(folder / "expected.json") << expected;

  const std::string command = std::string(CHOREO_TEST_DATA) + "/web/check_glb.sh '" +
                              (folder / "a.glb").string() + "' '" +
                              (folder / "expected.json").string() + "'";
  const Outcome outcome = Shell(command);
  if (outcome.code == 77) GTEST_SKIP() << outcome.said;
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

}  // namespace choreo::gltf_web_test
