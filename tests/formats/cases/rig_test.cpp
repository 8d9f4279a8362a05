#include <cmath>
#include <string>
#include <vector>

#include "model/fit/bones/find_bones.h"
#include "model/motion/kinematics/mirror.h"
#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::cases_test {

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

// As CMU's, whose collars begin where the neck does. They shrug.
TEST_F(CasesTest, CollarsThatBeginAtTheNecksBase) {
  const RigNames names = NamesOf("CMU");
  const RigTurn shrugs = [](const std::string& bone, int frame) -> Eigen::Matrix3d {
    if (bone == "left_collar") return About(0, 0, 1, 12 * std::sin(frame * 0.3));
    return Expressive(bone, frame);
  };
  for (const RigTurn& turn : {RigTurn(Expressive), shrugs}) {
    BvhFile file = MakeBvh({.names = names, .turn = turn});
    const auto offset = [&](const std::string& bone) -> Eigen::Vector3d& {
      const auto named = [&](const BvhJoint& joint) { return joint.name == names(bone); };
      return std::ranges::find_if(file.joints, named)->offset;
    };
    for (const std::string side : {"left_", "right_"}) {
      offset(side + "shoulder") += offset(side + "collar") - offset("neck");
      offset(side + "collar") = offset("neck");
    }
    const Read read = ReadBytes("a.bvh", BvhText(file));
    const Wrong wrong = Compare(read.motion, turn);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    const int left = kSmpl.left_shoulder, right = kSmpl.right_shoulder;
    const Eigen::Matrix3Xd rest = JointPositions(kSmpl, RestPose(kSmpl));
    const Eigen::Matrix3Xd ours = JointPositions(kSmpl, read.motion.frames[0]);
    EXPECT_NEAR((ours.col(left) - ours.col(right)).norm(),
                (rest.col(left) - rest.col(right)).norm(), 0.02);
  }
}

double LowestToe(const Pose& pose) {
  const Eigen::Matrix3Xd at = JointPositions(kSmpl, pose);
  return std::min(at(1, kSmpl.feet[1]), at(1, kSmpl.feet[3]));
}

// The length of the stay does not matter.
TEST_F(CasesTest, StepsOntoAStageKeepTheirHeight) {
  BvhFile file = MakeBvh({.turn = Expressive, .frames = 600});
  const auto rise = [&](double height, double whole) {
    for (int frame = 0; frame < 600; ++frame)
      file.values(1, frame) += whole + (frame >= 200 && frame < 500 ? height : 0);
  };
  const Motion level = ReadBytes("a.bvh", BvhText(file)).motion;
  rise(60, 0);
  const Read read = ReadBytes("a.bvh", BvhText(file));
  EXPECT_TRUE(read.notes.empty()) << Said(read);
  for (const size_t frame : {100U, 220U, 350U, 480U, 550U}) {
    EXPECT_NEAR(LowestToe(read.motion.frames[frame]) - LowestToe(level.frames[frame]),
                frame >= 200 && frame < 500 ? 0.6 : 0, 0.02)
        << frame;
  }
  // A short stay on the floor does not matter, either.
  BvhFile stairs = MakeBvh({.turn = Expressive, .frames = 600});
  for (int frame = 0; frame < 600; ++frame) stairs.values(1, frame) += 0.5 * frame;
  const Motion climbs = ReadBytes("a.bvh", BvhText(stairs)).motion;
  EXPECT_NEAR(LowestToe(climbs.frames[0]), LowestToe(level.frames[0]), 0.05);
  EXPECT_NEAR(LowestToe(climbs.frames[599]) - LowestToe(level.frames[599]), 3, 0.06);
  rise(0, 150);
  const Read hangs = ReadBytes("a.bvh", BvhText(file));
  EXPECT_TRUE(hangs.Says("in height onto the floor")) << Said(hangs);
  EXPECT_LT(WorstJoint(read.motion, hangs.motion), 0.01);
}

TEST_F(CasesTest, NotesPositionsInAnotherUnit) {
  BvhFile file = MakeBvh({.turn = Expressive});
  file.values.topRows(3) /= 100;
  const Read read = ReadBytes("a.bvh", BvhText(file));
  EXPECT_TRUE(read.Says("are its root's places in another unit than its bones?")) << Said(read);
}

TEST_F(CasesTest, AnUnusableRestPoseIsEstimatedFromTheClip) {
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
  EXPECT_TRUE(read.Says("not a standing body")) << Said(read);
  EXPECT_LT(Compare(read.motion, Walk).limbs, 0.1);
  // The head's turn at rest is unknown; its turns from there are kept.
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

TEST_F(CasesTest, NotesZUp) {
  WriteBvh(folder_ / "base.bvh", MakeBvh({.turn = Expressive}));
  const Motion base = ReadFile("base.bvh").motion;
  const Eigen::Matrix3d z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  WriteBvh(folder_ / "z.bvh", MakeBvh({.turn = Expressive, .world = z_up}));
  const Read read = ReadFile("z.bvh");
  EXPECT_TRUE(read.Says("read as z up, not y")) << Said(read);
  EXPECT_LT(WorstJoint(base, read.motion), 0.01);
  // A dancer who lies for a while stands as the rest pose does.
  const RigTurn falls = [](const std::string& bone, int frame) -> Eigen::Matrix3d {
    if (bone == "pelvis" && frame < 6) return About(1, 0, 0, 90);
    return Expressive(bone, frame);
  };
  WriteBvh(folder_ / "falls.bvh", MakeBvh({.turn = falls, .world = z_up}));
  const Read fallen = ReadFile("falls.bvh");
  EXPECT_TRUE(fallen.Says("as its rest pose then stands")) << Said(fallen);
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

TEST_F(CasesTest, MeaninglessNamesGetAdvice) {
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

// As a map is made by hand: arms or legs are mended by where they stand, the whole by toes, and
// without toes by where knees bend.
TEST_F(CasesTest, SidesFollowFromPositions) {
  const RigNames human = NamesOf(kHumanIkRig);
  const BvhFile file = MakeBvh({.names = human, .turn = Expressive});
  BvhFile toeless = file;
  for (BvhJoint& joint : toeless.joints)
    if (joint.name.find("ToeBase") != std::string::npos) joint.name = "x" + joint.name.substr(0, 1);
  const auto mapped = [&](const auto& is_wrong) {
    MotionReading reading;
    for (const RigJoint& joint : RigBody()) {
      if (joint.bone.ends_with("_foot")) continue;
      const std::string bone = is_wrong(joint.bone) ? OtherSide(joint.bone) : joint.bone;
      reading.bones.push_back({.bone = joint.bone, .name = human(bone), .field = "map"});
    }
    return reading;
  };
  const auto arm = [](const std::string& bone) {
    return bone.ends_with("collar") || bone.ends_with("shoulder") || bone.ends_with("elbow") ||
           bone.ends_with("wrist");
  };
  WriteBvh(folder_ / "a.bvh", file);
  const Read arms = ReadFile("a.bvh", mapped(arm));
  EXPECT_TRUE(arms.Says("its arms' left and right are exchanged")) << Said(arms);
  EXPECT_LT(Compare(arms.motion, Expressive).turns, kOpen);
  const Read legs = ReadFile("a.bvh", mapped([&](const auto& bone) { return !arm(bone); }));
  EXPECT_TRUE(legs.Says("left and right are exchanged")) << Said(legs);
  EXPECT_LT(Compare(legs.motion, Expressive).limbs, 0.1);
  WriteBvh(folder_ / "a.bvh", toeless);
  const Read whole = ReadFile("a.bvh", mapped([](const auto&) { return true; }));
  EXPECT_TRUE(whole.Says("its left and right are exchanged")) << Said(whole);
  EXPECT_LT(Compare(whole.motion, Expressive).limbs, 0.1);
}

TEST_F(CasesTest, NotesAMotionlessFile) {
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
  for (const char* extension : {".npz", ".pkl", ".npy", ".bvh", ".glb", ".gltf", ".vrma"}) {
    EXPECT_TRUE(IsMotionFile(std::string("a") + extension));
    EXPECT_NE(page.find("| `" + std::string(extension) + "` |"), std::string::npos) << extension;
    EXPECT_NE(MotionFileExtensions().find(extension), std::string::npos);
  }
}

}  // namespace choreo::cases_test
