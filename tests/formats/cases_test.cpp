#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "model/core/atomic_file.h"
#include "model/fit/find_bones.h"
#include "model/formats/amass_npz.h"
#include "model/formats/motion_file.h"
#include "model/formats/npz.h"
#include "model/motion/floor_clearance.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"
#include "tests/support/rig_files.h"
#include "tests/support/temporary_folder.h"

/// What people bring: a row each, a file made here, how it is read, what is right.
namespace choreo::cases_test {

using namespace testing_support;
using std::string_literals::operator""s;

const Skeleton& kSmpl = Skeleton::Smpl24();

struct Read {
  Motion motion;
  std::vector<std::string> notes;
  bool Says(const std::string& part) const {
    return std::ranges::any_of(notes, [&](const std::string& note) {
      return note.find(part) != std::string::npos && note.find('\n') == std::string::npos;
    });
  }
};

std::string Said(const Read& read) {
  std::string all;
  for (const std::string& note : read.notes) all += "\n  " + note;
  return all;
}

class CasesTest : public testing::Test {
 protected:
  Read ReadFile(const std::string& name, MotionReading reading = {}) const {
    Read read;
    reading.notes = &read.notes;
    read.motion = ReadMotion(folder_ / name, kSmpl, OtherSkeleton::kRetarget, reading);
    return read;
  }
  Read ReadBytes(const std::string& name, const std::string& bytes,
                 const MotionReading& reading = {}) const {
    WriteFile(folder_ / name, bytes);
    return ReadFile(name, reading);
  }
  Read ReadNpz(const NpzArchive& npz, const MotionReading& reading = {}) const {
    npz.Write(folder_ / "a.npz");
    return ReadFile("a.npz", reading);
  }

  TemporaryFolder folder_;
};

double WorstJoint(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.frames.size(), b.frames.size());
  double worst = 0;
  for (size_t i = 0; i < std::min(a.frames.size(), b.frames.size()); ++i) {
    worst =
        std::max(worst, (JointPositions(kSmpl, a.frames[i]) - JointPositions(kSmpl, b.frames[i]))
                            .colwise()
                            .norm()
                            .maxCoeff());
  }
  return worst;
}

double Degrees(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return LogMap(a.transpose() * b).norm() * kDegrees;
}

double Degrees(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

/// How far a motion is from what the rig did, degrees: limbs' directions, and how head, chest,
/// pelvis, hands and feet are turned in the world since rest.
struct Wrong {
  double limbs = 0, turns = 0;
  std::string where;
};
Wrong Compare(const Motion& motion, const RigTurn& turn, int step = 1) {
  Wrong wrong;
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const JointPlacement ours = ForwardKinematics(kSmpl, motion.frames[frame]);
    const RigState theirs = MoveRig(turn, static_cast<int>(frame) * step);
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : {std::pair("hip", "knee"), std::pair("knee", "ankle"),
                                     std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")}) {
        const double angle = Degrees(Eigen::Vector3d(ours.positions.col(kSmpl.Find(side + to)) -
                                                     ours.positions.col(kSmpl.Find(side + from))),
                                     Eigen::Vector3d(theirs.places.col(RigIndex(side + to)) -
                                                     theirs.places.col(RigIndex(side + from))));
        wrong.limbs = std::max(wrong.limbs, angle);
      }
    }
    for (const auto& [joint, bone] :
         {std::pair("head", "head"), std::pair("spine3", "spine3"), std::pair("pelvis", "pelvis"),
          std::pair("left_wrist", "left_wrist"), std::pair("right_wrist", "right_wrist"),
          std::pair("left_ankle", "left_ankle"), std::pair("right_ankle", "right_ankle")}) {
      const double angle = Degrees(ours.rotations[static_cast<size_t>(kSmpl.Find(joint))],
                                   theirs.turns[static_cast<size_t>(RigIndex(bone))]);
      if (angle > wrong.turns) wrong.turns = angle, wrong.where = joint;
    }
  }
  return wrong;
}

// What rest poses leave open: SMPL's forearms do not point straight out to the sides.
constexpr double kOpen = 5;

// A head that looks aside, a hand that is rolled, a forearm that is twisted, a chest that leans, a
// foot that is turned: all that positions do not tell.
Eigen::Matrix3d Expressive(const std::string& bone, int frame) {
  if (bone == "head") return About(0, 1, 0, 60);
  if (bone == "left_wrist") return About(1, 0, 0, 90);
  if (bone == "right_elbow") return About(0, 1, 0, 30) * About(1, 0, 0, -70);
  if (bone == "spine3") return About(1, 0, 0, 20);
  if (bone == "left_ankle") return About(0, 1, 0, 25);
  return Walk(bone, frame);
}

// ---- text

TEST_F(CasesTest, BvhAsOtherToolsWriteIt) {
  const BvhFile file = MakeBvh({});
  const std::string good = BvhText(file);
  const Motion base = ReadBytes("base.bvh", good).motion;
  const auto replaced = [&](std::string from, const std::string& to) {
    std::string text = good;
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    EXPECT_NE(text, good) << from;
    return text;
  };
  std::u16string wide(good.begin(), good.end());
  const auto utf16 = [&](bool big, const std::string& mark) {
    std::string bytes = mark;
    for (const char16_t unit : wide) {
      const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
      bytes += big ? std::string{high, low} : std::string{low, high};
    }
    return bytes;
  };
  struct Row {
    const char* name;
    std::string bytes;
    std::string says;
  };
  for (const Row& row : std::vector<Row>{
           {"less", replaced("Frames: 30", "Frames: 29"), "says 29 frames; all 30"},
           {"nospace", replaced("Frames: 30", "Frames:30"), ""},
           {"nocolon", replaced("Frames: 30", "Frames 30"), ""},
           {"space before", replaced("Frame Time:", "Frame Time :"), ""},
           {"EndSite", replaced("End Site", "EndSite"), ""},
           {"named end", replaced("End Site", "End Site Nub"), ""},
           {"small", replaced("End Site", "end site"), ""},
           {"commas", replaced(".", ","), ""},
           {"comments", "# made by hand\n" + replaced("MOTION", "// frames\nMOTION # all"), ""},
           {"BOM", "\xEF\xBB\xBF" + good, ""},
           {"UTF-16 LE", utf16(false, "\xFF\xFE"), ""},
           {"UTF-16 BE", utf16(true, "\xFE\xFF"), ""},
           {"UTF-16", utf16(false, ""), ""},
           {"blank lines", replaced("\n", "\r\n\r\n"), ""},
           {"no rate", replaced("Frame Time: 0.033333333", "Frame Time: 0"), "states no rate"},
       }) {
    SCOPED_TRACE(row.name);
    const Read read = ReadBytes("a.bvh", row.bytes);
    EXPECT_LT(WorstJoint(base, read.motion), 1e-4);
    EXPECT_EQ(read.motion.fps, 30);
    EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
    EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
  }
  const std::string slow = replaced("Frame Time: 0.033333333", "Frame Time: 0");
  EXPECT_EQ(ReadBytes("a.bvh", slow, {.fps = 120}).motion.fps, 120);
}

TEST_F(CasesTest, OnePoseNeedsNoFrameTime) {
  BvhRig rig;
  rig.frames = 1;
  std::string text = BvhText(MakeBvh(rig));
  text.replace(text.find("Frame Time: "), 23, "Frame Time: 0.000000");
  const Read read = ReadBytes("a.bvh", text);
  EXPECT_EQ(read.motion.frames.size(), 1U);
  EXPECT_TRUE(read.notes.empty()) << Said(read);
}

TEST_F(CasesTest, SixChannelsThatAreZeroLeaveTheOffsets) {
  const BvhFile file = MakeBvh({});
  WriteBvh(folder_ / "base.bvh", file);
  BvhFile six = file;
  Eigen::Index rows = 0, row = 0;
  for (BvhJoint& joint : six.joints) {
    if (joint.parent >= 0 && !joint.end_site) {
      joint.channels.insert(joint.channels.begin(), {BvhChannel::kXPosition, BvhChannel::kYPosition,
                                                     BvhChannel::kZPosition});
    }
    rows += std::ssize(joint.channels);
  }
  six.values.setZero(rows, file.frames());
  Eigen::Index from = 0;
  for (const BvhJoint& joint : six.joints) {
    const Eigen::Index count = joint.end_site ? 0 : joint.parent < 0 ? 6 : 3;
    row += std::ssize(joint.channels) - count;
    six.values.middleRows(row, count) = file.values.middleRows(from, count);
    row += count, from += count;
  }
  const Read read = ReadBytes("a.bvh", BvhText(six));
  EXPECT_TRUE(read.Says("their offsets are taken")) << Said(read);
  EXPECT_LT(WorstJoint(ReadFile("base.bvh").motion, read.motion), 1e-4);
  BvhFile flat = file;
  for (BvhJoint& joint : flat.joints) joint.offset.setZero();
  WriteBvh(folder_ / "flat.bvh", flat);
  ExpectError(ErrorCode::kInvalidArgument, "flat.bvh: bones: its legs have no length",
              [&] { ReadFile("flat.bvh"); });
}

// ---- rigs

TEST_F(CasesTest, EveryRigThatWeKnowKeepsItsTurns) {
  for (const std::string_view rig : AllRigNames()) {
    SCOPED_TRACE(rig);
    WriteBvh(folder_ / "a.bvh", MakeBvh({.names = NamesOf(rig), .turn = Expressive}));
    const Read read = ReadFile("a.bvh");
    const Wrong wrong = Compare(read.motion, Expressive);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    EXPECT_TRUE(std::ranges::none_of(read.notes, [](const std::string& note) {
      return note.find("has no") == std::string::npos;
    })) << Said(read);
  }
}

TEST_F(CasesTest, NamesAreSpeltInManyWays) {
  const RigNames mixamo = NamesOf(kHumanIkRig);
  const std::vector<std::pair<const char*, RigNames>> spelt = {
      {"numbered",
       [&](const auto& bone) {
         return "mixamorig:" + mixamo(bone) + "_0" + std::to_string(RigIndex(bone));
       }},
      {"small",
       [&](const auto& bone) {
         std::string name = mixamo(bone);
         std::ranges::transform(name, name.begin(),
                                [](unsigned char c) { return std::tolower(c); });
         return name;
       }},
      {"three.js",
       [](const auto& bone) {
         std::string name = NameInRig("Rigify", bone);
         std::erase(name, '.');
         return name;
       }},
      {"actor", [&](const auto& bone) { return "Robot_" + mixamo(bone); }},
  };
  for (const auto& [name, names] : spelt) {
    SCOPED_TRACE(name);
    WriteBvh(folder_ / "a.bvh", MakeBvh({.names = names, .turn = Expressive}));
    EXPECT_LT(Compare(ReadFile("a.bvh").motion, Expressive).turns, kOpen);
  }
}

TEST_F(CasesTest, ARestPoseThatIsNoBodyIsMadeOutOfTheClip) {
  // As Maya writes it: all bones along x.
  BvhRig rig{.turn = Walk, .frames = 60};
  rig.zero = [](const std::string& bone) -> Eigen::Matrix3d {
    if (bone.starts_with("right_") && (bone.ends_with("shoulder") || bone.ends_with("elbow")))
      return About(0, 0, 1, 180);
    const bool leg = bone.ends_with("hip") || bone.ends_with("knee");
    const bool trunk = bone.starts_with("spine") || bone == "pelvis" || bone == "neck";
    return About(0, 0, 1, leg ? 90 : trunk ? -90 : 0);
  };
  WriteBvh(folder_ / "a.bvh", MakeBvh(rig));
  const Read read = ReadFile("a.bvh");
  EXPECT_TRUE(read.Says("no standing body")) << Said(read);
  EXPECT_LT(Compare(read.motion, Walk).limbs, 0.1);
  // How the head is turned at rest nobody says; how it turns from there is kept.
  const auto looks = [](const std::string& bone, int frame) -> Eigen::Matrix3d {
    if (bone == "head") return About(0, 1, 0, 60 * std::sin(frame * 0.2));
    return Walk(bone, frame);
  };
  rig.turn = looks;
  WriteBvh(folder_ / "a.bvh", MakeBvh(rig));
  const Motion motion = ReadFile("a.bvh").motion;
  const auto head = [&](size_t frame) {
    return ForwardKinematics(kSmpl, motion.frames[frame])
        .rotations[static_cast<size_t>(kSmpl.Find("head"))];
  };
  const auto theirs = [&](int frame) {
    return MoveRig(looks, frame).turns[static_cast<size_t>(RigIndex("head"))];
  };
  for (const int frame : {8, 24, 40})
    EXPECT_NEAR(Degrees(head(0), head(static_cast<size_t>(frame))),
                Degrees(theirs(0), theirs(frame)), 5);
}

TEST_F(CasesTest, ZUpStandsAndIsSaid) {
  WriteBvh(folder_ / "base.bvh", MakeBvh({.turn = Expressive}));
  const Motion base = ReadFile("base.bvh").motion;
  const Eigen::Matrix3d z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  WriteBvh(folder_ / "z.bvh", MakeBvh({.turn = Expressive, .world = z_up}));
  const Read read = ReadFile("z.bvh");
  EXPECT_TRUE(read.Says("taken as z up, not y")) << Said(read);
  EXPECT_LT(WorstJoint(base, read.motion), 0.01);
  // One who lies for a while stands as her rest pose does.
  const RigTurn falls = [](const std::string& bone, int frame) -> Eigen::Matrix3d {
    if (bone == "pelvis" && frame < 6) return About(1, 0, 0, 90);
    return Expressive(bone, frame);
  };
  WriteBvh(folder_ / "falls.bvh", MakeBvh({.turn = falls, .world = z_up}));
  const Read fallen = ReadFile("falls.bvh");
  EXPECT_TRUE(fallen.Says("as its rest pose stands so")) << Said(fallen);
  EXPECT_LT(Compare(fallen.motion, falls).turns, kOpen);
  // Our names do not make a rig ours.
  const RigNames ours = [](const std::string& bone) { return bone == "pelvis" ? "root" : bone; };
  WriteBvh(folder_ / "root.bvh", MakeBvh({.names = ours, .turn = Expressive, .world = z_up}));
  EXPECT_LT(Compare(ReadFile("root.bvh").motion, Expressive).turns, kOpen);
  const Read told = ReadFile("z.bvh", {.up = "z"});
  EXPECT_TRUE(told.notes.empty()) << Said(told);
  EXPECT_LT(WorstJoint(base, told.motion), 0.01);
  EXPECT_LT(std::abs(JointPositions(kSmpl, ReadFile("z.bvh", {.up = "y"}).motion.frames[0])(
                1, kSmpl.Find("head"))),
            1);
  ExpectError(ErrorCode::kInvalidArgument, "--up: \"w\" is none of x, y, z",
              [&] { ReadFile("z.bvh", {.up = "w"}); });
}

TEST_F(CasesTest, NamesThatSayNothingHaveAWayOut) {
  const RigNames nameless = [](const std::string& bone) {
    return "bone" + std::to_string(RigIndex(bone));
  };
  WriteBvh(folder_ / "a.bvh", MakeBvh({.names = nameless, .turn = Expressive}));
  try {
    ReadFile("a.bvh");
    FAIL();
  } catch (const UnknownBones& error) {
    EXPECT_EQ(error.rig().names.size(), 27U);
    EXPECT_NE(std::string(error.what()).find("a.bvh: its names do not say"), std::string::npos);
  }
  MotionReading mapped;
  for (const RigJoint& joint : RigBody())
    mapped.bones.push_back({.bone = joint.bone, .name = nameless(joint.bone), .field = "map"});
  EXPECT_LT(Compare(ReadFile("a.bvh", mapped).motion, Expressive).turns, kOpen);
  mapped.bones[3].name = "x";
  ExpectError(ErrorCode::kInvalidArgument, "map: \"x\" is none of its nodes",
              [&] { ReadFile("a.bvh", mapped); });
}

// ---- glTF

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

TEST_F(CasesTest, BonesAreFoundByWhatTheyAre) {
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
       "has 2 animations; \"dance\" is read, --animation chooses \"door\""},
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

TEST_F(CasesTest, TwoBodiesThatMoveAreSaid) {
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
  EXPECT_TRUE(ReadBytes("a.glb", glb.Bytes()).Says("several bodies that move"));
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
              "--animation: \"jump\" is none of its 2 animations, \"walk\", \"dance\"",
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

// ---- arrays

/// A body that steps, in SMPL's terms, by 20 frames; Z up as AMASS has it.
struct SmplArrays {
  Motion motion;  ///< ours
  std::vector<double> root, body, trans;

  explicit SmplArrays(int frames = 20) {
    motion.fps = 30;
    for (int frame = 0; frame < frames; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.Find("head")) << 0, 0.5, 0.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      root.insert(root.end(), amass.rotations.data(), amass.rotations.data() + 3);
      body.insert(body.end(), amass.rotations.data() + 3, amass.rotations.data() + 66);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  int64_t frames() const { return std::ssize(motion.frames); }
  NpyArray Root() const { return {{frames(), 3}, root}; }
  NpyArray Body() const { return {{frames(), 63}, body}; }
  NpyArray Trans() const { return {{frames(), 3}, trans}; }
  // All 22 joints, `width` values each, as `state` has a rotation vector.
  std::vector<double> All(const std::function<std::vector<double>(Eigen::Vector3d)>& state,
                          int joints) const {
    std::vector<double> all;
    for (int64_t frame = 0; frame < frames(); ++frame) {
      for (int joint = 0; joint < joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint == 0)
          turn = Eigen::Map<const Eigen::Vector3d>(&root[3 * static_cast<size_t>(frame)]);
        if (joint > 0 && joint < 22) {
          turn = Eigen::Map<const Eigen::Vector3d>(
              &body[static_cast<size_t>(63 * frame + 3 * (joint - 1))]);
        }
        const std::vector<double> values = state(turn);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }
};

std::vector<double> AsMatrix(const Eigen::Vector3d& turn) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> m = ExpMap(turn);
  return {m.data(), m.data() + 9};
}
std::vector<double> AsRows(const Eigen::Vector3d& turn) {
  std::vector<double> m = AsMatrix(turn);
  m.resize(6);
  return m;
}
std::vector<double> AsColumns(const Eigen::Vector3d& turn) {
  const auto six = SixDFromMatrix(ExpMap(turn));
  return {six.begin(), six.end()};
}
std::vector<double> AsVector(const Eigen::Vector3d& turn) { return {turn.begin(), turn.end()}; }

TEST_F(CasesTest, ArraysOfEveryKind) {
  const SmplArrays smpl;
  struct Row {
    const char* name;
    std::map<std::string, NpyArray> arrays;
    std::string says = "";
  };
  const NpyArray rate{{}, std::vector<double>{30}};
  const int64_t f = smpl.frames();
  const std::vector<Row> rows = {
      {"split",
       {{"root_orient", smpl.Root()},
        {"pose_body", smpl.Body()},
        {"trans", smpl.Trans()},
        {"mocap_frame_rate", rate}}},
      {"smplx",
       {{"global_orient", smpl.Root()}, {"body_pose", smpl.Body()}, {"transl", smpl.Trans()}},
       "states no rate"},
      {"fps",
       {{"poses", {{f, 156}, smpl.All(AsVector, 52)}},
        {"trans", smpl.Trans()},
        {"fps", {{}, std::vector<int64_t>{30}}}}},
      {"22 joints",
       {{"poses", {{f, 22, 3}, smpl.All(AsVector, 22)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"no rate",
       {{"poses", {{f, 72}, smpl.All(AsVector, 24)}}, {"trans", smpl.Trans()}},
       "states no rate"},
      {"matrices",
       {{"poses", {{f, 24, 3, 3}, smpl.All(AsMatrix, 24)}},
        {"trans", smpl.Trans()},
        {"fps", rate}}},
      {"flat matrices",
       {{"poses", {{f, 216}, smpl.All(AsMatrix, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D",
       {{"poses", {{f, 24, 6}, smpl.All(AsRows, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D by columns",
       {{"poses", {{f, 144}, smpl.All(AsColumns, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"a batch of one",
       {{"poses", {{1, f, 72}, smpl.All(AsVector, 24)}},
        {"trans", {{1, f, 3}, smpl.trans}},
        {"fps", rate}}},
  };
  for (const Row& row : rows) {
    for (const bool pickled : {false, true}) {
      SCOPED_TRACE(row.name + std::string(pickled ? " pkl" : " npz"));
      NpzArchive npz;
      for (const auto& [key, array] : row.arrays) npz.SetArray(key, array);
      if (pickled) WritePickle(folder_ / "a.pkl", row.arrays);
      const Read read = pickled ? ReadFile("a.pkl") : ReadNpz(npz);
      EXPECT_EQ(read.motion.fps, 30);
      EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
      EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
      EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
    }
  }
  NpzArchive npz;
  npz.SetArray("poses", {{f, 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  EXPECT_EQ(ReadNpz(npz, {.fps = 50}).motion.fps, 50);
  npz.SetArray("poses", {{f, 24, 3, 3}, std::vector<double>(static_cast<size_t>(f) * 216, 0.5)});
  ExpectError(ErrorCode::kInvalidArgument, "a.npz: poses[0][0]: is no rotation matrix",
              [&] { ReadNpz(npz); });
}

TEST_F(CasesTest, ArraysWhoseAxesOrUnitAreOthers) {
  const SmplArrays smpl;
  const auto file = [&](bool y_up, double unit) {
    std::vector<double> poses, trans;
    for (const Pose& pose : smpl.motion.frames) {
      const Pose stated = y_up ? pose : ToAmass(pose);
      poses.insert(poses.end(), stated.rotations.data(), stated.rotations.data() + 72);
      const Eigen::Vector3d place =
          (y_up ? Eigen::Vector3d(pose.root_position - SmplRestPelvis()) : stated.root_position);
      for (const double value : place) trans.push_back(value / unit);
    }
    NpzArchive npz;
    npz.SetArray("poses", {{smpl.frames(), 72}, poses});
    npz.SetArray("trans", {{smpl.frames(), 3}, trans});
    npz.SetArray("fps", {{}, std::vector<double>{30}});
    return npz;
  };
  const Read y_up = ReadNpz(file(true, 1));
  EXPECT_TRUE(y_up.Says("taken as y up, not z")) << Said(y_up);
  EXPECT_LT(WorstJoint(smpl.motion, y_up.motion), 1e-6);
  EXPECT_TRUE(ReadNpz(file(true, 1), {.up = "y"}).notes.empty());
  const Read centimetres = ReadNpz(file(false, 0.01));
  EXPECT_TRUE(centimetres.Says("taken as centimetres")) << Said(centimetres);
  EXPECT_LT(WorstJoint(smpl.motion, centimetres.motion), 1e-6);
  EXPECT_LT(WorstJoint(smpl.motion, ReadNpz(file(false, 0.5), {.scale = 0.5}).motion), 1e-6);
}

TEST_F(CasesTest, AnotherBodysFeetStandOnTheFloor) {
  SmplArrays smpl;
  for (size_t i = 2; i < smpl.trans.size(); i += 3) smpl.trans[i] -= 0.09;
  NpzArchive npz;
  npz.SetArray("poses", {{smpl.frames(), 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  npz.SetArray("fps", {{}, std::vector<double>{30}});
  npz.SetArray("betas", {{10}, std::vector<double>(10, 1.5)});
  const Read read = ReadNpz(npz);
  EXPECT_TRUE(read.Says("betas are another body's")) << Said(read);
  EXPECT_NEAR(HeightAboveFloor(kSmpl, read.motion.frames[0]), 0, 0.01);
  npz.SetArray("betas", {{10}, std::vector<double>(10, 0.0)});
  EXPECT_TRUE(ReadNpz(npz).Says("its feet were under the floor"));
}

TEST_F(CasesTest, WhatDoesNotMoveIsSaid) {
  const auto still = [](const std::string& bone, int) { return Walk(bone, 0); };
  BvhFile file = MakeBvh({.turn = still});
  file.values.topRows(3).colwise() = file.values.topRows(3).col(0).eval();
  EXPECT_TRUE(ReadBytes("a.bvh", BvhText(file)).Says("nothing moves in its 30 frames"));
  const auto broken = [](const std::string& bone, int frame) -> Eigen::Matrix3d {
    return bone.ends_with("_knee") ? About(1, 0, 0, -60) : Walk(bone, frame);
  };
  WriteBvh(folder_ / "a.bvh", MakeBvh({.turn = broken}));
  EXPECT_TRUE(ReadFile("a.bvh").Says("bent as no body can"));
}

TEST_F(CasesTest, ThePageNamesEveryFormatAndRig) {
  const std::string page =
      choreo::ReadFile(std::filesystem::path(CHOREO_TEST_DATA) / "../../docs/files.md");
  for (const std::string_view rig : AllRigNames())
    EXPECT_NE(page.find(rig), std::string::npos) << rig;
  for (const char* extension : {".npz", ".pkl", ".bvh", ".glb", ".vrma"}) {
    EXPECT_TRUE(IsMotionFile(std::string("a") + extension));
    EXPECT_NE(page.find("| `" + std::string(extension) + "` |"), std::string::npos) << extension;
    EXPECT_NE(MotionFileExtensions().find(extension), std::string::npos);
  }
}

}  // namespace choreo::cases_test
