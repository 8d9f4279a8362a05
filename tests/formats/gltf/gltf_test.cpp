#include "model/formats/gltf/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

#include "model/formats/bvh/bvh.h"
#include "model/formats/gltf/gltf_scene.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/glb_parts.h"
#include "tests/support/mixamo_names.h"
#include "tests/support/temporary_folder.h"

namespace choreo::gltf_test {

using nlohmann::json;
using testing_support::Glb;

const Skeleton& kSmpl = Skeleton::Smpl24();

double WorstJoint(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.frames.size(), b.frames.size());
  double worst = 0;
  for (size_t i = 0; i < std::min(a.frames.size(), b.frames.size()); ++i)
    worst = std::max(worst, ComparePoses(kSmpl, a.frames[i], b.frames[i]).position_m);
  return worst;
}

class GltfTest : public testing::Test {
 protected:
  // The file after `change`, read back.
  Motion ReadChanged(const std::function<void(Glb&)>& change) {
    WriteGlb(folder_ / "a.glb", kSmpl, motion_);
    Glb glb(folder_ / "a.glb");
    change(glb);
    glb.Write(folder_ / "changed.glb");
    return ReadGlb(folder_ / "changed.glb").motion;
  }

  TemporaryFolder folder_;
  const Motion motion_ = fixtures::SmoothMotion(kSmpl, 11, 45, 30);
};

TEST_F(GltfTest, HoldsTheRestBodyAndTheMotion) {
  WriteGlb(folder_ / "a.glb", kSmpl, motion_);
  const Glb glb(folder_ / "a.glb");
  const json& document = glb.document;
  EXPECT_EQ(document["asset"]["version"], "2.0");
  ASSERT_EQ(document["skins"][0]["joints"].size(), 24u);
  for (int joint = 0; joint < 24; ++joint) {
    const json& node = document["nodes"][joint];
    EXPECT_EQ(node["name"], kSmpl.joint_names[joint]);
    EXPECT_FALSE(node.contains("rotation"));
    Eigen::Vector3d rest = kSmpl.offsets.col(joint);
    if (joint == 0) rest.y() = kSmpl.pelvis_height;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(node["translation"][axis].get<double>(), rest[axis], 1e-12);
  }
  // Bound at rest: what takes a vertex into a joint's frame undoes where the joint is at rest.
  const Eigen::Matrix3Xd rest = JointPositions(kSmpl, RestPose(kSmpl));
  const std::vector<float> inverse = glb.Floats(document["skins"][0]["inverseBindMatrices"]);
  for (int joint = 0; joint < 24; ++joint) {
    const Eigen::Matrix4f matrix = Eigen::Map<const Eigen::Matrix4f>(&inverse[16 * joint]);
    EXPECT_LT((matrix.topRightCorner<3, 1>().cast<double>() + rest.col(joint)).norm(), 1e-6);
    EXPECT_TRUE(matrix.topLeftCorner(3, 3).isIdentity());
  }
  EXPECT_EQ(document["animations"][0]["channels"].size(), 25u);
  // A body as large as a person, with its feet on the floor.
  double low = 1, high = 0;
  for (const json& primitive : document["meshes"][0]["primitives"]) {
    const json& positions = document["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    low = std::min(low, positions["min"][1].get<double>());
    high = std::max(high, positions["max"][1].get<double>());
    EXPECT_TRUE(primitive["attributes"].contains("NORMAL"));
    EXPECT_TRUE(primitive.contains("material"));
  }
  EXPECT_NEAR(low, 0, 0.02);
  EXPECT_NEAR(high, 1.8, 0.05);  // with the bun
}

TEST_F(GltfTest, ARootOnTheFloorCarriesTheDancerOrNoneDoes) {
  const auto scene = [&](RootMotion root) {
    WriteGlb(folder_ / "a.glb", kSmpl, motion_, root);
    return ReadGltfScene(folder_ / "a.glb");
  };
  const GltfScene usual = scene(RootMotion::kPelvis), carried = scene(RootMotion::kRoot),
                  in_place = scene(RootMotion::kInPlace);
  const auto root = std::ranges::find(carried.nodes.names, "root") - carried.nodes.names.begin();
  ASSERT_LT(root, std::ssize(carried.nodes.names));
  EXPECT_EQ(carried.nodes.parents[0], root);
  EXPECT_EQ(Glb(folder_ / "a.glb").document["skins"][0]["joints"].size(), 24U);
  for (int64_t frame = 0; frame < usual.frames; ++frame) {
    const auto a = usual.Frame(frame), b = carried.Frame(frame), c = in_place.Frame(frame);
    for (size_t joint = 0; joint < 24; ++joint) {
      EXPECT_TRUE(a[joint].isApprox(b[joint], 1e-4)) << "the dance is the same";
      EXPECT_TRUE(a[joint].linear().isApprox(c[joint].linear(), 1e-4));
    }
    const GroundFrame place = GroundFrame::Of(motion_.frames[static_cast<size_t>(frame)]);
    const Eigen::Affine3d way = b[static_cast<size_t>(root)];
    EXPECT_LT((way.translation() - place.origin).norm(), 1e-4);
    EXPECT_LT((way.linear() * Eigen::Vector3d::UnitZ() -
               Eigen::Vector3d(std::sin(place.heading), 0, std::cos(place.heading)))
                  .norm(),
              1e-4);
    EXPECT_LT(std::hypot(c[0].translation().x(), c[0].translation().z()), 1e-6);
    EXPECT_NEAR(c[0].translation().y(), a[0].translation().y(), 1e-6);
  }
}

TEST_F(GltfTest, TheSameMotionGivesTheSameBytes) {
  WriteGlb(folder_ / "a.glb", kSmpl, motion_);
  WriteGlb(folder_ / "b.glb", kSmpl, motion_);
  const Glb a(folder_ / "a.glb"), b(folder_ / "b.glb");
  EXPECT_EQ(a.document, b.document);
  EXPECT_EQ(a.binary, b.binary);
}

TEST_F(GltfTest, RoundTripsAnyRateAndASingleFrame) {
  for (const double fps : {30.0, 59.94, 24.0, 120.0, 12.5}) {
    Motion motion = motion_;
    motion.fps = fps;
    WriteGlb(folder_ / "a.glb", kSmpl, motion);
    const Motion back = ReadGlb(folder_ / "a.glb").motion;
    EXPECT_EQ(back.fps, fps);
    EXPECT_LT(WorstJoint(motion, back), 2e-6);
  }
  Motion one = motion_;
  one.frames.resize(1);
  WriteGlb(folder_ / "a.glb", kSmpl, one);
  EXPECT_LT(WorstJoint(one, ReadGlb(folder_ / "a.glb").motion), 2e-6);
}

TEST_F(GltfTest, FindsAnUnstatedRate) {
  const Motion back = ReadChanged([](Glb& glb) { glb.document["animations"][0].erase("extras"); });
  EXPECT_EQ(back.fps, 30);
  EXPECT_LT(WorstJoint(motion_, back), 2e-6);
}

TEST_F(GltfTest, BonesMayHaveAnyFrameAtRest) {
  // As Blender's: an elbow whose node is turned at rest, with its child turned back.
  const int elbow = kSmpl.Find("left_elbow"), wrist = kSmpl.Find("left_wrist");
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const Motion back = ReadChanged([&](Glb& glb) {
    json& nodes = glb.document["nodes"];
    nodes[elbow]["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
    const Eigen::Vector3d inside = turn.inverse() * Eigen::Vector3d(kSmpl.offsets.col(wrist));
    nodes[wrist]["translation"] = {inside.x(), inside.y(), inside.z()};
    nodes[wrist]["rotation"] = {-turn.x(), -turn.y(), -turn.z(), turn.w()};
    // The elbow turns in its parent, the wrist in the elbow's turned frame.
    for (const json& channel : glb.document["animations"][0]["channels"]) {
      const int node = channel["target"]["node"];
      if (channel["target"]["path"] != "rotation" || (node != elbow && node != wrist)) continue;
      const int output =
          glb.document["animations"][0]["samplers"][channel["sampler"].get<int>()]["output"];
      std::vector<float> values = glb.Floats(output);
      for (size_t i = 0; i < values.size(); i += 4) {
        Eigen::Map<Eigen::Quaternionf> value(&values[i]);
        const Eigen::Quaternionf narrow = turn.cast<float>();
        value = node == elbow ? Eigen::Quaternionf(value * narrow)
                              : Eigen::Quaternionf(narrow.inverse() * value);
      }
      const json& view =
          glb.document["bufferViews"][glb.document["accessors"][output]["bufferView"].get<int>()];
      std::memcpy(glb.binary.data() + view["byteOffset"].get<size_t>(), values.data(),
                  values.size() * sizeof(float));
    }
  });
  EXPECT_LT(WorstJoint(motion_, back), 2e-6);
}

TEST_F(GltfTest, FitsAnotherSkeleton) {
  // Mixamo's names, twice as large, under a node that turns and scales.
  const Motion back = ReadChanged([&](Glb& glb) {
    json& nodes = glb.document["nodes"];
    for (json& node : nodes) {
      const auto found = kMixamoNames.find(node["name"].get<std::string>());
      if (found != kMixamoNames.end()) node["name"] = "mixamorig:" + found->second;
    }
    nodes.push_back({{"name", "Armature"},
                     {"children", {0}},
                     {"scale", {2, 2, 2}},
                     {"rotation", {0, 1, 0, 0}}});  // half a turn about Y
    glb.document["scenes"][0]["nodes"][0] = nodes.size() - 1;
  });
  EXPECT_EQ(back.fps, 30);
  ASSERT_EQ(back.frames.size(), motion_.frames.size());
  double sum = 0;
  for (size_t i = 0; i < back.frames.size(); ++i) {
    const Eigen::Matrix3Xd a = JointPositions(kSmpl, motion_.frames[i]);
    Eigen::Matrix3Xd b = JointPositions(kSmpl, back.frames[i]);
    b.row(0) *= -1, b.row(2) *= -1;  // half a turn back
    sum +=
        ((a.colwise() - a.col(0).eval()) - (b.colwise() - b.col(0).eval())).colwise().norm().mean();
  }
  EXPECT_LT(sum / static_cast<double>(back.frames.size()), 0.03);
}

TEST_F(GltfTest, RefusesWhatItCannotRead) {
  const auto refuse = [&](const std::string& part, const std::function<void(Glb&)>& change) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { ReadChanged(change); });
    ExpectError(ErrorCode::kInvalidArgument, (folder_ / "changed.glb").string(),
                [&] { ReadGlb(folder_ / "changed.glb"); });
  };
  refuse("animations: there is none", [](Glb& glb) { glb.document.erase("animations"); });
  refuse("moves no node",
         [](Glb& glb) { glb.document["animations"][0]["channels"] = json::array(); });
  refuse("a CUBICSPLINE has three each", [](Glb& glb) {
    glb.document["animations"][0]["samplers"][3]["interpolation"] = "CUBICSPLINE";
  });
  const auto times = [](Glb& glb) -> json& {
    return glb
        .document["accessors"][glb.document["animations"][0]["samplers"][0]["input"].get<int>()];
  };
  refuse("reaches beyond its buffer", [&](Glb& glb) { times(glb)["count"] = 1u << 30; });
  refuse("reaches beyond its buffer",
         [&](Glb& glb) { times(glb)["byteOffset"] = uint64_t{1} << 40; });
  refuse("44 times", [&](Glb& glb) { times(glb)["count"] = 44; });
  refuse("neither floats nor normalized", [&](Glb& glb) { times(glb)["componentType"] = 5125; });
  refuse("accessors: there is no number 9999",
         [](Glb& glb) { glb.document["animations"][0]["samplers"][0]["output"] = 9999; });
  refuse("nodes: there is no number 999",
         [](Glb& glb) { glb.document["animations"][0]["channels"][0]["target"]["node"] = 999; });
  refuse("has two parents", [](Glb& glb) { glb.document["nodes"][24]["children"] = {5}; });
  refuse("their own ancestors", [](Glb& glb) { glb.document["nodes"][10]["children"] = {0}; });
  refuse("extras.fps", [](Glb& glb) { glb.document["animations"][0]["extras"]["fps"] = 0; });
  refuse("21025 in 1467 frames, at most 30000000 places", [](Glb& glb) {
    glb.document["animations"][0]["extras"]["fps"] = 1000;
    while (glb.document["nodes"].size() < 21'025) glb.document["nodes"].push_back({{"name", "a"}});
  });
  refuse("is not a binary glTF",
         [](Glb& glb) { glb.document["buffers"][0]["uri"] = "/etc/passwd"; });
  refuse("is not a binary glTF", [](Glb& glb) { glb.document = "nothing"; });
  refuse("its names do not say which bone is the", [](Glb& glb) {
    for (json& node : glb.document["nodes"]) node["name"] = "bone";
  });

  std::ofstream(folder_ / "text.glb") << "no glTF";
  ExpectError(ErrorCode::kInvalidArgument, "text.glb: is not a binary glTF",
              [&] { ReadGlb(folder_ / "text.glb"); });
  ExpectError(ErrorCode::kNotFound, "absent.glb", [&] { ReadGlb(folder_ / "absent.glb"); });
  ExpectError(ErrorCode::kInternal, "cannot be written",
              [&] { WriteGlb("/absent/a.glb", kSmpl, motion_); });
  ExpectError(ErrorCode::kInvalidArgument, "0 frames",
              [&] { WriteGlb(folder_ / "a.glb", kSmpl, Motion{}); });
  Motion broken = motion_;
  broken.frames[3].rotations(0, 0) = std::nan("");
  ExpectError(ErrorCode::kInvalidArgument, "motion.frames[3]: holds values that are not finite",
              [&] { WriteGlb(folder_ / "a.glb", kSmpl, broken); });
}

// A file cut off anywhere is refused, not crashed on.
TEST_F(GltfTest, SurvivesTruncation) {
  WriteGlb(folder_ / "a.glb", kSmpl, motion_);
  std::ifstream file(folder_ / "a.glb", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 37) {
    std::ofstream(folder_ / "cut.glb", std::ios::binary) << bytes.substr(0, length);
    ExpectError(ErrorCode::kInvalidArgument, "is not a binary glTF",
                [&] { ReadGlb(folder_ / "cut.glb"); });
  }
}

}  // namespace choreo::gltf_test
