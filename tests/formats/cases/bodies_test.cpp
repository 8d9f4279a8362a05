// Files with several bodies, or with one in parts, and rigs whose files are incomplete or
// misleading: a row each, as in log_test.cpp.
#include <functional>
#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::bodies_test {

using namespace cases_test;

const Eigen::Matrix3d kZUp{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

RigNames With(const std::string& before, const RigNames& names, const std::string& after = "") {
  return [=](const std::string& bone) { return before + names(bone) + after; };
}

BvhFile Dancing(const RigNames& names, const RigTurn& turn = Expressive) {
  return MakeBvh({.names = names, .turn = turn});
}

BvhFile Still(const RigNames& names) {
  BvhFile file = Dancing(names, [](const auto& bone, int) { return Walk(bone, 0); });
  file.values.colwise() = file.values.col(0).eval();
  return file;
}

// Two hierarchies in one file.
BvhFile Together(const BvhFile& first, const BvhFile& second) {
  BvhFile both = first;
  for (BvhJoint joint : second.joints) {
    if (joint.parent >= 0) joint.parent += static_cast<int>(first.joints.size());
    both.joints.push_back(joint);
  }
  both.values.resize(first.values.rows() + second.values.rows(), first.frames());
  both.values << first.values, second.values;
  return both;
}

BvhFile Stick() {
  BvhFile file;
  file.joints.push_back(
      {.name = "Stick",
       .offset = {0, 100, 0},
       .channels = {BvhChannel::kXPosition, BvhChannel::kYPosition, BvhChannel::kZPosition,
                    BvhChannel::kZRotation, BvhChannel::kXRotation, BvhChannel::kYRotation}});
  file.joints.push_back(
      {.name = "Stick_end", .parent = 0, .offset = {0, 90, 0}, .channels = {}, .end_site = true});
  file.values = Eigen::MatrixXd::Random(6, 30) * 90;
  return file;
}

BvhFile InRadians(BvhFile file) {
  Eigen::Index row = 0;
  for (const BvhJoint& joint : file.joints) {
    for (const BvhChannel channel : joint.channels) {
      if (channel >= BvhChannel::kXRotation) file.values.row(row) /= kDegrees;
      ++row;
    }
  }
  return file;
}

// Sways on the spot, arms held out.
Eigen::Matrix3d Sways(const std::string& bone, int frame) {
  return About(1, 0.3, 0.2, 3 * std::sin(frame * 0.3 + static_cast<double>(bone.size())));
}

// A dancer spins on without end: the file does not wrap the angle.
BvhFile Spinning(const RigNames& names) {
  BvhFile file = Dancing(names);
  for (Eigen::Index frame = 0; frame < file.frames(); ++frame)
    file.values(5, frame) += 25.0 * static_cast<double>(frame);
  return file;
}
Eigen::Matrix3d Spins(const std::string& bone, int frame) {
  const Eigen::Matrix3d turn = Expressive(bone, frame);
  return bone == "pelvis" ? turn * About(0, 1, 0, 25.0 * frame) : turn;
}

// Waves, as far as degrees below 6 allow.
Eigen::Matrix3d Waves(const std::string& bone, int frame) {
  return bone.ends_with("shoulder") ? About(0, 0, 1, 5 * std::sin(frame * 0.3))
                                    : Eigen::Matrix3d::Identity();
}

// On its back, on the floor.
Eigen::Matrix3d Lies(const std::string& bone, int frame) {
  if (bone == "pelvis") return About(1, 0, 0, -90);
  if (bone.ends_with("_hip")) return About(1, 0, 0, -25 + 15 * std::sin(frame * 0.3));
  return bone.ends_with("_knee") ? About(1, 0, 0, 10) : Walk(bone, frame);
}

BvhFile LyingZUp() {
  BvhFile file = MakeBvh({.turn = Lies, .world = kZUp});
  file.values.row(2).setConstant(12);
  return file;
}

struct Row {
  const char* name;
  std::string bytes;
  RigTurn right = Expressive;
  const char* says = "";
  const char* angles = "";  ///< --angles
};

TEST_F(CasesTest, TheLogOfBodiesInBvh) {
  const RigNames names = NamesOf(kHumanIkRig);
  std::string slow = BvhText(Dancing(names));
  slow.replace(slow.find("Frame Time: "), 23, "Frame Time: 33.33333333");
  for (const Row& row : std::vector<Row>{
           {"a partner below a second root",
            BvhText(Together(Dancing(With("A:", names)), Dancing(With("B:", names), Walk))),
            Expressive, "holds 2 bodies that move"},
           {"a still twin of another namespace first",
            BvhText(Together(Still(With("Dummy:", names)), Dancing(With("Actor:", names))))},
           {"a still twin first, numbers after the names of the one that moves",
            BvhText(Together(Still(names), Dancing(With("", names, ".001"))))},
           {"a prop first", BvhText(Together(Stick(), Dancing(names)))},
           {"names that all end alike", BvhText(Dancing(With("c_", names, "_bind_jnt")))},
           {"radians", BvhText(InRadians(Dancing(names))), Expressive, "are read as radians"},
           {"radians of one who spins on", BvhText(InRadians(Spinning(names))), Spins,
            "are read as radians, as they are so small; --angles degrees"},
           {"the same, told", BvhText(InRadians(Spinning(names))), Spins, "", "radians"},
           {"degrees of one who spins on", BvhText(Spinning(names)), Spins},
           {"one who sways a little", BvhText(Dancing(names, Sways)), Sways,
            "are read as degrees, though they are small; --angles radians"},
           {"the same, told", BvhText(Dancing(names, Sways)), Sways, "", "degrees"},
           {"arms that wave a little", BvhText(Dancing(names, Waves)), Waves, "", "degrees"},
           {"milliseconds", slow, Expressive, "which is read as milliseconds"},
           {"on the floor of a Z-up file", BvhText(LyingZUp()), Lies, "read as z up, not y"},
       }) {
    SCOPED_TRACE(row.name);
    const Read read = ReadBytes("a.bvh", row.bytes, {.angles = row.angles});
    EXPECT_EQ(read.motion.fps, 30);
    const Wrong wrong = Compare(read.motion, row.right);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
}

// One pose has no pace; whose head turns further than others sway is no root that spins on.
TEST_F(CasesTest, FewAnglesHaveTheStatedUnit) {
  const RigNames names = NamesOf(kHumanIkRig);
  BvhFile one = InRadians(Spinning(names));
  one.values = one.values.rightCols(1).eval();
  const Read read = ReadBytes("a.bvh", BvhText(one), {.angles = "radians"});
  ASSERT_EQ(read.motion.frames.size(), 1U);
  EXPECT_TRUE(read.notes.empty()) << Said(read);
  const RigTurn looks = [](const std::string& bone, int frame) {
    return bone == "head" ? About(0, 1, 0, 0.9 * frame) : Waves(bone, frame);
  };
  EXPECT_TRUE(ReadBytes("a.bvh", BvhText(Dancing(names, looks))).notes.empty());
}

struct GlbRow {
  const char* name;
  std::function<void(GlbRigs&, const RigNames&)> make;
  const char* says = "";
};

TEST_F(CasesTest, TheLogOfBodiesInGltf) {
  const RigNames human = NamesOf(kHumanIkRig), rigify = NamesOf("Rigify");
  const auto dance = [](GlbRigs& glb, const RigNames& names) {
    const int body = glb.AddBody(names);
    glb.AddAnimation("dance", body, Expressive, 20);
    return body;
  };
  const auto target = [](GlbRigs::Json& channel) {
    const std::string node = std::to_string(channel["target"]["node"].get<int>());
    const std::string path = channel["target"]["path"];
    channel["target"] = {
        {"path", "pointer"},
        {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/" + node + "/" + path}}}}}};
  };
  for (const GlbRow& row : std::vector<GlbRow>{
           {"a still twin first, numbers after the names of the one that moves",
            [&](GlbRigs&glb, const RigNames&names) {
              glb.AddSkin(glb.AddBody(names, 2));
              glb.AddSkin(dance(glb, With("", names, ".001")));
            }},
           {"Rigify's ORG- bones move, its DEF- bones do not",
            [&](GlbRigs&glb, const RigNames&) {
              glb.AddBody(With("DEF-", rigify), 2);
              dance(glb, With("ORG-", rigify));
            }},
           {"an animation for each node",
            [&](GlbRigs&glb, const RigNames&names) {
              dance(glb, names);
              const GlbRigs::Json whole = glb.document["animations"][0];
              glb.document["animations"] = GlbRigs::Json::array();
              for (auto channel : whole["channels"]) {
                const auto sampler = whole["samplers"][channel["sampler"].get<size_t>()];
                auto& animations = glb.document["animations"];
                const auto same = std::ranges::find_if(animations, [&](const auto& animation) {
                  return animation["channels"][0]["target"]["node"] == channel["target"]["node"];
                });
                if (same != animations.end()) {
                  channel["sampler"] = 1;
                  (*same)["channels"].push_back(channel);
                  (*same)["samplers"].push_back(sampler);
                } else {
                  channel["sampler"] = 0;
                  animations.push_back({{"channels", GlbRigs::Json::array({channel})},
                                        {"samplers", GlbRigs::Json::array({sampler})}});
                }
              }
            },
            "moves a part of the body: they are read as one"},
           {"channels that say by pointers what they move",
            [&](GlbRigs&glb, const RigNames&names) {
              dance(glb, names);
              for (auto& channel : glb.document["animations"][0]["channels"]) target(channel);
            }},
           {"some of them",
            [&](GlbRigs&glb, const RigNames&names) {
              dance(glb, names);
              for (size_t i = 0; i < 12; ++i) target(glb.document["animations"][0]["channels"][i]);
            }},
           {"hair with more joints, bound in other axes, before the body",
            [&](GlbRigs&glb, const RigNames&names) {
              const int body = dance(glb, names);
              GlbRigs::Json joints = GlbRigs::Json::array();
              std::vector<float> inverse;
              Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
              matrix.topLeftCorner<3, 3>() = About(1, 0, 0, 90).cast<float>();
              for (int i = 0; i < 40; ++i) {
                joints.push_back(glb.AddNode({{"name", "hair" + std::to_string(i)}}));
                glb.document["nodes"][body + RigIndex("head")]["children"].push_back(joints.back());
                inverse.insert(inverse.end(), matrix.data(), matrix.data() + 16);
              }
              glb.document["skins"].push_back(
                  {{"joints", joints}, {"inverseBindMatrices", glb.AddFloats(inverse, "MAT4")}});
            }},
           {"times in milliseconds",
            [&](GlbRigs&glb, const RigNames&names) {
              dance(glb, names);
              std::vector<float> times;
              for (int frame = 0; frame < 20; ++frame)
                times.push_back(static_cast<float>(frame / 0.03));
              const size_t input = glb.AddFloats(times, "SCALAR");
              for (auto& sampler : glb.document["animations"][0]["samplers"])
                sampler["input"] = input;
            },
            "their times are read as milliseconds"},
       }) {
    SCOPED_TRACE(row.name);
    GlbRigs glb;
    row.make(glb, human);
    const Read read = ReadBytes("a.glb", glb.Bytes());
    EXPECT_EQ(read.motion.fps, 30);
    EXPECT_EQ(read.motion.frames.size(), 20U);
    const Wrong wrong = Compare(read.motion, Expressive);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
}

TEST_F(CasesTest, APoseOfADanceIsNoRestPose) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  for (const RigJoint& joint : RigBody()) {
    const Eigen::Quaterniond q(Expressive(joint.bone, 7));
    glb.document["nodes"][body + RigIndex(joint.bone)]["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  }
  const Read read = ReadBytes("a.glb", glb.Bytes());
  EXPECT_TRUE(read.Says("its rest pose is not a standing body")) << Said(read);
  EXPECT_LT(Compare(read.motion, Expressive).limbs, 0.1);
}

TEST_F(CasesTest, BodiesAreChosen) {
  const RigNames names = NamesOf(kHumanIkRig);
  const auto reads = [&](const std::string& body, const RigTurn& right) {
    SCOPED_TRACE(body);
    const Read read = ReadFile("a.bvh", {.body = body});
    EXPECT_LT(Compare(read.motion, right).turns, kOpen);
    EXPECT_TRUE(read.notes.empty()) << Said(read);
  };
  const std::string hips = names("pelvis");
  const BvhFile pair = Together(Dancing(With("A:", names)), Dancing(With("B:", names), Walk));
  EXPECT_TRUE(ReadBytes("a.bvh", BvhText(pair))
                  .Says("holds 2 bodies that move, 0 \"A:" + hips + "\", 1 \"B:" + hips +
                        "\"; 0 is read, --body chooses"));
  reads("A:" + hips, Expressive), reads("0", Expressive);
  reads("B:" + hips, Walk), reads("1", Walk);
  for (const std::string body : {"2", "C"}) {
    ExpectError(ErrorCode::kInvalidArgument,
                "--body: \"" + body + "\" is none of its bodies, 0 \"A:", [&] {
                  ReadFile("a.bvh", {.body = body});
                });
  }
  ExpectError(ErrorCode::kInvalidArgument, "--body: --map already chooses the bones", [&] {
    ReadFile("a.bvh", {.body = "1", .bones = {{.bone = "head", .node = 5, .field = "map"}}});
  });
  WriteFile(folder_ / "a.bvh", BvhText(Together(Dancing(names), Dancing(names, Walk))));
  reads("1", Walk);
  ExpectError(ErrorCode::kInvalidArgument, "--body: \"" + hips + "\" is several of its bodies, 0 ",
              [&] { ReadFile("a.bvh", {.body = hips}); });
  // Of a file of one, too.
  WriteFile(folder_ / "a.bvh", BvhText(Dancing(names)));
  reads("0", Expressive);
  ExpectError(ErrorCode::kInvalidArgument, "--body: \"1\" is none of its bodies, 0 \"" + hips,
              [&] { ReadFile("a.bvh", {.body = "1"}); });
}

// The bodies of one animation, each bound by a skin of its own.
TEST_F(CasesTest, BodiesOfGltfAreChosen) {
  GlbRigs glb;
  const RigNames names = NamesOf(kHumanIkRig);
  for (const RigTurn& turn : {RigTurn(Expressive), RigTurn(Walk)}) {
    const int body = glb.AddBody(names);
    glb.AddSkin(body);
    glb.AddAnimation("dance", body, turn, 20);
  }
  GlbRigs::Json& animations = glb.document["animations"];
  const size_t samplers = animations[0]["samplers"].size();
  for (GlbRigs::Json channel : animations[1]["channels"]) {
    channel["sampler"] = channel["sampler"].get<size_t>() + samplers;
    animations[0]["channels"].push_back(channel);
  }
  for (const GlbRigs::Json& sampler : animations[1]["samplers"])
    animations[0]["samplers"].push_back(sampler);
  animations.erase(1);
  EXPECT_TRUE(ReadBytes("a.glb", glb.Bytes()).Says("holds 2 bodies that move"));
  EXPECT_LT(Compare(ReadFile("a.glb", {.body = "0"}).motion, Expressive).turns, kOpen);
  EXPECT_LT(Compare(ReadFile("a.glb", {.body = "1"}).motion, Walk).turns, kOpen);
}

}  // namespace choreo::bodies_test
