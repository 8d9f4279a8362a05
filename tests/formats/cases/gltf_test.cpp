#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::cases_test {

TEST_F(CasesTest, AGltfsRigKeepsItsTurns) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  const Read read = ReadBytes("a.glb", glb.Bytes());
  const Wrong wrong = Compare(read.motion, Expressive);
  EXPECT_LT(wrong.limbs, 0.1);
  EXPECT_LT(wrong.turns, kOpen) << wrong.where;
  EXPECT_TRUE(read.notes.empty()) << Said(read);
}

// Scales that differ by axis shear what hangs below: it is read as viewers show it.
TEST_F(CasesTest, StretchedBonesAreReadAsTheyAreSeen) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  const Eigen::Vector3d stretched(1.15, 0.8, 1.1);
  const int chest = RigIndex("spine3");
  glb.document["nodes"][static_cast<size_t>(body + chest)]["scale"] = {1.15, 0.8, 1.1};
  const Read read = ReadBytes("a.glb", glb.Bytes());
  for (size_t frame = 0; frame < read.motion.frames.size(); ++frame) {
    std::vector<Eigen::Affine3d> seen;
    for (size_t i = 0; i < RigBody().size(); ++i) {
      const int parent = RigIndex(RigBody()[i].parent);
      Eigen::Affine3d local(Eigen::Translation3d(RigBody()[i].offset));
      local.rotate(Expressive(RigBody()[i].bone, static_cast<int>(frame)));
      if (static_cast<int>(i) == chest) local.scale(stretched);
      seen.push_back(parent < 0 ? local : seen[static_cast<size_t>(parent)] * local);
    }
    const JointPlacement ours = ForwardKinematics(kSmpl, read.motion.frames[frame]);
    const auto bone = [&](const std::string& name) {
      return seen[static_cast<size_t>(RigIndex(name))];
    };
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : {std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")}) {
        EXPECT_LT(Degrees(Eigen::Vector3d(ours.positions.col(kSmpl.Find(side + to)) -
                                          ours.positions.col(kSmpl.Find(side + from))),
                          Eigen::Vector3d(bone(side + to).translation() -
                                          bone(side + from).translation())),
                  0.1);
      }
    }
    for (const char* name : {"head", "spine3", "left_wrist", "right_wrist"}) {
      EXPECT_LT(Degrees(ours.rotations[static_cast<size_t>(kSmpl.Find(name))],
                        Eigen::Matrix3d(bone(name).rotation())),
                kOpen)
          << name;
    }
  }
}

TEST_F(CasesTest, FindsBonesByTheirStructure) {
  const RigNames names = NamesOf(kHumanIkRig);
  struct Row {
    const char* name;
    std::function<void(GlbRigs&)> make;
    std::string says = "";
  };
  const auto stray = [](GlbRigs& glb, bool mesh) {
    for (const char* name : {"Head", "LeftHand", "RightFoot"}) {
      GlbRigs::Json node = {{"name", name}, {"translation", {5, 5, 5}}};
      if (mesh) node["mesh"] = 0;
      glb.AddNode(node);
    }
  };
  const std::vector<Row> rows = {
      {"meshes of the same names before the bones",
       [&](GlbRigs& glb) {
         stray(glb, true);
         glb.AddAnimation("dance", glb.AddBody(names), Expressive, 20);
       }},
      {"and nodes that are nothing",
       [&](GlbRigs& glb) {
         stray(glb, false);
         glb.AddAnimation("dance", glb.AddBody(names), Expressive, 20);
       }},
      {"a still twin before the one that moves",
       [&](GlbRigs& glb) {
         glb.AddSkin(glb.AddBody(names, 2));
         const int body = glb.AddBody(names);
         glb.AddSkin(body);
         glb.AddAnimation("dance", body, Expressive, 20);
       }},
      {"a twin whose keys are all the same",
       [&](GlbRigs& glb) {
         const int twin = glb.AddBody(names, 2), body = glb.AddBody(names);
         glb.AddAnimation("dance", body, Expressive, 20);
         auto& channels = glb.document["animations"][0]["channels"];
         auto& samplers = glb.document["animations"][0]["samplers"];
         std::vector<float> still;
         for (int frame = 0; frame < 20; ++frame) still.insert(still.end(), {0, 0, 0, 1});
         samplers.push_back(
             {{"input", samplers[0]["input"]}, {"output", glb.AddFloats(still, "VEC4")}});
         for (int i = 0; i < 22; ++i) {
           channels.push_back({{"sampler", samplers.size() - 1},
                               {"target", {{"node", twin + i}, {"path", "rotation"}}}});
         }
       }},
      {"VRM's table of an animation",
       [&](GlbRigs& glb) {
         const int body =
             glb.AddBody([](const auto& bone) { return "n" + std::to_string(RigIndex(bone)); });
         glb.AddAnimation("dance", body, Expressive, 20);
         GlbRigs::Json table;
         for (const RigJoint& joint : RigBody())
           table[NameInRig("VRM", joint.bone)] = {{"node", body + RigIndex(joint.bone)}};
         glb.document["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"] = table;
       }},
      {"several animations, the first moves something else",
       [&](GlbRigs& glb) {
         const int body = glb.AddBody(names);
         const int door = glb.AddNode({{"name", "door"}});
         glb.AddAnimation("dance", body, Expressive, 20);
         auto dance = glb.document["animations"][0];
         auto other = dance;
         other["name"] = "door";
         other["channels"] = GlbRigs::Json::array({dance["channels"][1]});
         other["channels"][0]["target"]["node"] = door;
         glb.document["animations"] = GlbRigs::Json::array({other, dance});
       },
       "has 2 animations; 1 \"dance\" (0.63 s) is read, --animation chooses 0 \"door\" "
       "(0.63 s)"},
      {"animations without names",
       [&](GlbRigs& glb) {
         const int body = glb.AddBody(names);
         glb.AddAnimation("", body, Expressive, 20);
         glb.AddAnimation("", body, Walk, 31);
         for (auto& animation : glb.document["animations"]) animation.erase("name");
       },
       "has 2 animations; 0 (0.63 s) is read, --animation chooses 1 (1 s)"},
      {"nodes that stand in the middle of the dance, and a skin bound at rest",
       [&](GlbRigs& glb) {
         const int body = glb.AddBody(names);
         glb.AddSkin(body);
         glb.AddAnimation("dance", body, Expressive, 20);
         for (const RigJoint& joint : RigBody()) {
           const Eigen::Quaterniond q(Expressive(joint.bone, 7));
           glb.document["nodes"][body + RigIndex(joint.bone)]["rotation"] = {q.x(), q.y(), q.z(),
                                                                             q.w()};
         }
       }},
      {"a compressed mesh",
       [&](GlbRigs& glb) {
         glb.AddAnimation("dance", glb.AddBody(names), Expressive, 20);
         glb.document["extensionsRequired"] = GlbRigs::Json::array({"KHR_draco_mesh_compression"});
         glb.document["meshes"] =
             GlbRigs::Json::parse(R"([{"primitives": [{"attributes": {"POSITION": 99}}]}])");
       }},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    GlbRigs glb;
    row.make(glb);
    for (const char* name : {"a.glb", "a.vrma"}) {
      const Read read = ReadBytes(name, glb.Bytes());
      const Wrong wrong = Compare(read.motion, Expressive);
      EXPECT_LT(wrong.limbs, 0.1);
      EXPECT_LT(wrong.turns, kOpen) << wrong.where;
      EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
      EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
    }
  }
}

TEST_F(CasesTest, AnUnknownBodyListsAnimations) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("", body, Expressive, 20);
  glb.AddAnimation("walk", body, Walk, 31);
  const std::string bytes = glb.Bytes();
  EXPECT_EQ(ReadBytes("a.glb", bytes, {.animation = "1"}).motion.frames.size(), 31U);
  ExpectError(ErrorCode::kInvalidArgument,
              "--body: \"1\" is none of its bodies, 0 \"Hips\"; of its animations, 0 (0.63 s), "
              "1 \"walk\" (1 s), --animation chooses",
              [&] { ReadBytes("a.glb", bytes, {.body = "1"}); });
  ExpectError(ErrorCode::kInvalidArgument, "--angles: is for arrays and .bvh",
              [&] { ReadBytes("a.glb", bytes, {.angles = "degrees"}); });
}

TEST_F(CasesTest, SecondsCountFromTheFirstKey) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  std::vector<float> times;
  for (int frame = 0; frame < 20; ++frame) times.push_back(12 + static_cast<float>(frame) / 30);
  const size_t input = glb.AddFloats(times, "SCALAR");
  for (auto& sampler : glb.document["animations"][0]["samplers"]) sampler["input"] = input;
  const Read read = ReadBytes("a.glb", glb.Bytes());
  EXPECT_EQ(read.motion.frames.size(), 20U);
  EXPECT_TRUE(read.Says("its first key is at 12 s, which is the motion's beginning")) << Said(read);
}

TEST_F(CasesTest, NotesTwoMovingBodies) {
  GlbRigs glb;
  const RigNames names = NamesOf(kHumanIkRig);
  const int first = glb.AddBody(names, 2), second = glb.AddBody(names);
  glb.AddAnimation("dance", first, Expressive, 20);
  glb.AddAnimation("other", second, Expressive, 20);
  auto& animations = glb.document["animations"];
  const size_t samplers = animations[0]["samplers"].size();
  for (auto channel : animations[1]["channels"]) {
    channel["sampler"] = channel["sampler"].get<size_t>() + samplers;
    animations[0]["channels"].push_back(channel);
  }
  for (const auto& sampler : animations[1]["samplers"])
    animations[0]["samplers"].push_back(sampler);
  animations.erase(1);
  EXPECT_TRUE(ReadBytes("a.glb", glb.Bytes()).Says("holds 2 bodies that move"));
}

TEST_F(CasesTest, AnAnimationIsChosen) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("walk", body, Walk, 20);
  glb.AddAnimation("dance", body, Expressive, 20);
  WriteFile(folder_ / "a.glb", glb.Bytes());
  EXPECT_LT(Compare(ReadFile("a.glb", {.animation = "dance"}).motion, Expressive).turns, kOpen);
  EXPECT_LT(Compare(ReadFile("a.glb", {.animation = "1"}).motion, Expressive).turns, kOpen);
  EXPECT_LT(Compare(ReadFile("a.glb").motion, Walk).turns, kOpen);
  // A pose that another animation holds is no dance.
  GlbRigs posed;
  const int posed_body = posed.AddBody(NamesOf(kHumanIkRig));
  posed.AddAnimation(
      "T", posed_body, [](const auto&, int) { return About(0, 1, 0, 0); }, 1);
  posed.AddAnimation("dance", posed_body, Expressive, 20);
  WriteFile(folder_ / "b.glb", posed.Bytes());
  EXPECT_LT(Compare(ReadFile("b.glb").motion, Expressive).turns, kOpen);
  ExpectError(ErrorCode::kInvalidArgument,
              "--animation: \"jump\" is none of its 2 animations, 0 \"walk\" (0.63 s), 1 \"dance\"",
              [&] { ReadFile("a.glb", {.animation = "jump"}); });
}

TEST_F(CasesTest, StepsHoldTheKeyOfTheirFrame) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Walk, 30);
  for (auto& sampler : glb.document["animations"][0]["samplers"]) sampler["interpolation"] = "STEP";
  const Read read = ReadBytes("a.glb", glb.Bytes());
  EXPECT_LT(Compare(read.motion, Walk).limbs, 0.1);
}

TEST_F(CasesTest, CubicSplinesAndCompressedAnimations) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Walk, 4);
  // Keys at 0, 0.3, 0.6 and 1 s, each between two tangents of zero.
  const size_t times = glb.AddFloats({0, 0.3F, 0.6F, 1}, "SCALAR");
  for (auto& channel : glb.document["animations"][0]["channels"]) {
    auto& sampler = glb.document["animations"][0]["samplers"][channel["sampler"].get<size_t>()];
    const size_t width = channel["target"]["path"] == "rotation" ? 4 : 3;
    const auto& view =
        glb.document["bufferViews"]
                    [glb.document["accessors"][sampler["output"].get<size_t>()]["bufferView"]
                         .get<size_t>()];
    std::vector<float> values(4 * width), spline;
    std::memcpy(values.data(), glb.binary.data() + view["byteOffset"].get<size_t>(), 16 * width);
    for (size_t key = 0; key < 4; ++key) {
      spline.insert(spline.end(), width, 0);
      spline.insert(spline.end(), values.begin() + static_cast<std::ptrdiff_t>(key * width),
                    values.begin() + static_cast<std::ptrdiff_t>((key + 1) * width));
      spline.insert(spline.end(), width, 0);
    }
    sampler = {{"input", times},
               {"interpolation", "CUBICSPLINE"},
               {"output", glb.AddFloats(spline, width == 4 ? "VEC4" : "VEC3")}};
  }
  const Motion motion = ReadBytes("a.glb", glb.Bytes()).motion;
  ASSERT_EQ(motion.frames.size(), 31U);
  Motion at_keys{.fps = 30, .frames = {}};
  for (const size_t frame : {0, 9, 18, 30}) at_keys.frames.push_back(motion.frames[frame]);
  EXPECT_LT(Compare(at_keys, Walk).limbs, 0.1);
  glb.document["bufferViews"].back()["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
  ExpectError(ErrorCode::kInvalidArgument, "is compressed by EXT_meshopt_compression",
              [&] { ReadBytes("a.glb", glb.Bytes()); });
}

}  // namespace choreo::cases_test
