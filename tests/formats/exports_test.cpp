// What we write, as others read it: joints are where we say they are.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "model/body/skin.h"
#include "model/fit/bones/human_bones.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/gltf/gltf.h"
#include "model/formats/motion_file.h"
#include "tests/formats/numpy.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace choreo::exports_test {

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

TEST(Exports, KhronosAndThreeJsReadOurGlb) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 50, 30);
  WriteGlb(folder / "a.glb", kSmpl, motion);
  json expected = {{"duration", 49.0 / 30}};
  // The last frame is left out: three.js starts over there.
  for (const size_t frame : {0, 1, 17, 48}) expected["frames"].push_back(Expected(motion, frame));
  std::ofstream(folder / "expected.json") << expected;

  const std::string command = std::string(CHOREO_TEST_DATA) + "/web/check.sh check_glb.mjs '" +
                              (folder / "a.glb").string() + "' '" +
                              (folder / "expected.json").string() + "'";
  const Outcome outcome = Shell(command);
  if (outcome.code == 77) GTEST_SKIP() << outcome.said;
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

TEST(Exports, VrmsPlayersReadOurVrma) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 50, 30);
  WriteMotion(folder / "a.vrma", kSmpl, motion);
  json expected = {{"duration", 49.0 / 30}};
  const auto bone = [](int joint) {
    const std::string& name = kSmpl.joint_names[static_cast<size_t>(joint)];
    return name.ends_with("_hand") ? std::string() : NameInRig(kVrmRig, name);
  };
  for (int joint = 0; joint < kSmpl.joints(); ++joint) {
    if (bone(joint).empty()) continue;
    const int parent = kSmpl.parents[static_cast<size_t>(joint)];
    const Eigen::Vector3d offset = parent < 0 ? Eigen::Vector3d(0, kSmpl.pelvis_height, 0)
                                              : Eigen::Vector3d(kSmpl.offsets.col(joint));
    expected["rest"].push_back({{"bone", bone(joint)},
                                {"parent", parent < 0 ? json() : json(bone(parent))},
                                {"offset", Numbers(offset)}});
  }
  for (const size_t frame : {0, 1, 17, 48}) {
    const Eigen::Matrix3Xd places = JointPositions(kSmpl, motion.frames[frame]);
    json at = {{"time", static_cast<double>(frame) / motion.fps}};
    for (int joint = 0; joint < kSmpl.joints(); ++joint)
      if (!bone(joint).empty()) at["joints"][bone(joint)] = Numbers(places.col(joint));
    expected["frames"].push_back(at);
  }
  std::ofstream(folder / "expected.json") << expected;
  const Outcome outcome =
      Shell(std::string(CHOREO_TEST_DATA) + "/web/check.sh check_vrma.mjs '" +
            (folder / "a.vrma").string() + "' '" + (folder / "expected.json").string() + "'");
  if (outcome.code == 77) GTEST_SKIP() << outcome.said;
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

// As AMASS's own tools pose their bodies: rotation vectors down the tree, then trans, Z up.
TEST(Exports, AmassArraysPoseTheSameJoints) {
  if (!HaveNumpy()) GTEST_SKIP() << "no python3 with numpy here";
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 50, 30);
  WriteMotion(folder / "a.npz", kSmpl, motion);
  json expected;
  Eigen::Matrix3Xd rest = kSmpl.offsets;
  rest.col(0) = SmplRestPelvis();
  for (int joint = 0; joint < 22; ++joint) {
    const int parent = kSmpl.parents[static_cast<size_t>(joint)];
    if (parent >= 0) rest.col(joint) += rest.col(parent);
    expected["parents"].push_back(parent);
    expected["rest"].push_back(Numbers(rest.col(joint)));
  }
  for (const size_t frame : {0, 17, 49}) {
    const Eigen::Matrix3Xd places = JointPositions(kSmpl, motion.frames[frame]);
    json joints;
    for (int joint = 0; joint < 22; ++joint) joints.push_back(Numbers(places.col(joint)));
    expected["frames"].push_back({{"frame", frame}, {"joints", joints}});
  }
  std::ofstream(folder / "expected.json") << expected;
  EXPECT_EQ(
      RunNumpy(folder / "a.npz",
               "import json, os\n"
               "want = json.load(open(os.path.join(os.path.dirname(path), 'expected.json')))\n"
               "d = np.load(path)\n"
               "rest = np.array(want['rest'])\n"
               "def turn(v):\n"
               "  a = np.linalg.norm(v)\n"
               "  x, y, z = v / a if a > 1e-12 else v\n"
               "  k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])\n"
               "  return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k\n"
               "worst = 0\n"
               "for frame in want['frames']:\n"
               "  vectors = d['poses'][frame['frame']].reshape(52, 3)\n"
               "  places, turns = [], []\n"
               "  for joint, parent in enumerate(want['parents']):\n"
               "    local = turn(vectors[joint])\n"
               "    if parent < 0:\n"
               "      places.append(rest[0] + d['trans'][frame['frame']])\n"
               "      turns.append(local)\n"
               "    else:\n"
               "      places.append(places[parent] + turns[parent] @ (rest[joint] - "
               "rest[parent]))\n"
               "      turns.append(turns[parent] @ local)\n"
               "  at = np.array(places) @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])\n"
               "  worst = max(worst, np.abs(at - np.array(frame['joints'])).max())\n"
               "print(d['poses'].shape, d['trans'].shape, float(d['mocap_framerate']), "
               "float(d['mocap_frame_rate']), str(d['gender']), d['betas'].shape, "
               "worst < 1e-6)\n"),
      "(50, 156) (50, 3) 30.0 30.0 neutral (16,) True\n");
}

}  // namespace choreo::exports_test
