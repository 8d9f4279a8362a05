// The log of files that were once read wrong, or refused without need. Each row has a way to make
// the file, the options of `choreo convert`, the right result, and the notes.
#include <cmath>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "model/formats/amass_npz.h"
#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::log_test {

using namespace cases_test;

const Eigen::Matrix3d kMirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();

std::string OtherSide(const std::string& bone) {
  if (bone.starts_with("left_")) return "right_" + bone.substr(5);
  return bone.starts_with("right_") ? "left_" + bone.substr(6) : bone;
}

// The motion of a body whose mirror image moves as `Expressive` describes.
Eigen::Matrix3d Mirrored(const std::string& bone, int frame) {
  return kMirror * Expressive(OtherSide(bone), frame) * kMirror;
}

// Dances on its back: on the floor all the time.
Eigen::Matrix3d Lying(const std::string& bone, int frame) {
  if (bone == "pelvis") return About(1, 0, 0, -90);
  if (bone.ends_with("_hip")) return About(1, 0, 0, -25 + 15 * std::sin(frame * 0.3));
  return bone.ends_with("_knee") ? About(1, 0, 0, 10) : Walk(bone, frame);
}

Eigen::Matrix3d HangingArms(const std::string& bone) {
  const bool arm =
      bone.ends_with("_shoulder") || bone.ends_with("_elbow") || bone.ends_with("_wrist");
  return arm ? About(0, 0, 1, bone.starts_with("left_") ? -88 : 88) : About(0, 1, 0, 0);
}

// Channels before and after the rotations of every joint but the root, with the same values
// throughout.
BvhFile WithChannels(const BvhFile& file, const std::vector<BvhChannel>& before, double position,
                     const std::vector<BvhChannel>& after, double scale) {
  BvhFile more = file;
  std::vector<Eigen::RowVectorXd> rows;
  Eigen::Index from = 0;
  const auto constant = [&](double value) {
    rows.emplace_back(Eigen::RowVectorXd::Constant(file.frames(), value));
  };
  for (size_t i = 0; i < file.joints.size(); ++i) {
    std::vector<BvhChannel>& channels = more.joints[i].channels;
    const bool adds = !file.joints[i].end_site && file.joints[i].parent >= 0;
    for (size_t k = 0; adds && k < before.size(); ++k) constant(position);
    for (size_t k = 0; k < channels.size(); ++k) rows.emplace_back(file.values.row(from++));
    for (size_t k = 0; adds && k < after.size(); ++k) constant(scale);
    if (!adds) continue;
    channels.insert(channels.begin(), before.begin(), before.end());
    channels.insert(channels.end(), after.begin(), after.end());
  }
  more.values.resize(std::ssize(rows), file.frames());
  for (size_t row = 0; row < rows.size(); ++row)
    more.values.row(static_cast<Eigen::Index>(row)) = rows[row];
  return more;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

BvhFile LyingOnTheFloor() {
  BvhFile file = MakeBvh({.turn = Lying});
  file.values.row(1).setConstant(12);
  return file;
}

std::string Dance(const std::function<void(GlbRigs&, int body)>& change,
                  const RigNames& names = NamesOf(kHumanIkRig), const RigTurn& turn = Expressive) {
  GlbRigs glb;
  const int body = glb.AddBody(names);
  glb.AddSkin(body);
  glb.AddAnimation("dance", body, turn, 20);
  change(glb, body);
  return glb.Bytes();
}

// All that hangs from a node of the whole, which is told.
GlbRigs::Json& Above(GlbRigs& glb, int body) {
  const int above = glb.AddNode({{"name", "Root"}, {"children", {body}}});
  return glb.document["nodes"][static_cast<size_t>(above)];
}

// Rotations by which of their numbers are not 0, as some exporters save room.
void MakeSparse(GlbRigs& glb) {
  for (auto& sampler : glb.document["animations"][0]["samplers"]) {
    auto& accessor = glb.document["accessors"][sampler["output"].get<size_t>()];
    const size_t view = accessor["bufferView"].get<size_t>(),
                 count = accessor["count"].get<size_t>();
    std::string indices;
    for (size_t i = 0; i < count; ++i) indices += {static_cast<char>(i), 0};
    indices.resize((indices.size() + 3) / 4 * 4);
    glb.document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", indices.size()}});
    glb.binary += indices;
    glb.document["buffers"][0]["byteLength"] = glb.binary.size();
    accessor.erase("bufferView");
    accessor["sparse"] = {
        {"count", count},
        {"indices",
         {{"bufferView", glb.document["bufferViews"].size() - 1}, {"componentType", 5123}}},
        {"values", {{"bufferView", view}}}};
  }
}

struct Row {
  const char* name;
  const char* file;
  std::string bytes;
  const char* options = "";  ///< of convert
  RigTurn right = Expressive;
  const char* says = "";  ///< a part of its note, or none
};

MotionReading Options(const std::string& words) {
  MotionReading reading;
  std::istringstream stream(words);
  for (std::string option, value; stream >> option >> value;) {
    if (option == "--up") reading.up = value;
    if (option == "--fps") reading.fps = std::stod(value);
    if (option == "--animation") reading.animation = value;
    if (option == "--angles") reading.angles = value;
  }
  return reading;
}

TEST_F(CasesTest, TheLogOfRigs) {
  const BvhFile base = MakeBvh({.turn = Expressive});
  const std::vector<BvhChannel> positions = {BvhChannel::kXPosition, BvhChannel::kYPosition,
                                             BvhChannel::kZPosition};
  const std::vector<BvhChannel> scales = {BvhChannel::kXScale, BvhChannel::kYScale,
                                          BvhChannel::kZScale};
  const RigNames mmd = [](const std::string& bone) {
    return bone == "pelvis" ? "下半身" : NameInRig("MMD", bone);
  };
  const std::vector<Row> rows = {
      {"more frames in the header than rows", "a.bvh",
       Replaced(BvhText(base), "Frames: 30", "Frames: 31"), "", Expressive,
       "says 31 frames; all 30"},
      {"six channels, places as small changes of the offsets", "a.bvh",
       BvhText(WithChannels(base, positions, 0.02, {}, 0)), "", Expressive,
       "0 or nearly so in all frames; their offsets are taken"},
      {"scale channels", "a.bvh", BvhText(WithChannels(base, {}, 0, scales, 1))},
      {"arms that hang at rest", "a.bvh",
       BvhText(MakeBvh({.turn = Expressive, .zero = HangingArms}))},
      {"left-handed axes", "a.bvh", BvhText(MakeBvh({.turn = Expressive, .world = kMirror})), "",
       Mirrored, "its left and right are exchanged"},
      {"on the floor all the time", "a.bvh", BvhText(LyingOnTheFloor()), "", Lying,
       "its body lies; --up"},
      {"the same, told", "a.bvh", BvhText(LyingOnTheFloor()), "--up y", Lying},
      {"sparse accessors", "a.glb", Dance([](GlbRigs& glb, int) { MakeSparse(glb); })},
      {"a mirror above a body that is mirrored", "a.glb", Dance([](GlbRigs& glb, int body) {
         Above(glb, body)["scale"] = {-1, 1, 1};
       }),
       "", Mirrored, "its left and right are exchanged"},
      {"legs hang from MMD's lower body", "a.glb",
       Dance([](GlbRigs& glb, int body) { Above(glb, body)["name"] = "センター"; }, mmd)},
      {"bound in axes of the skin's own, and on the floor", "a.glb",
       Dance(
           [](GlbRigs& glb, int body) {
             // As if the mesh lay in an armature whose Z is up.
             const auto view = glb.document["skins"][0]["inverseBindMatrices"].get<size_t>();
             const auto offset =
                 glb.document["bufferViews"][glb.document["accessors"][view]["bufferView"]
                                                 .get<size_t>()]["byteOffset"]
                     .get<size_t>();
             Eigen::Matrix4f z_up = Eigen::Matrix4f::Identity();
             z_up.topLeftCorner<3, 3>() = About(1, 0, 0, -90).cast<float>();
             for (size_t i = 0; i < RigBody().size(); ++i) {
               Eigen::Matrix4f matrix;
               std::memcpy(matrix.data(), glb.binary.data() + offset + 64 * i, 64);
               matrix = matrix * z_up;
               std::memcpy(glb.binary.data() + offset + 64 * i, matrix.data(), 64);
             }
             // Without a key, the pelvis stands where its node does.
             auto& channels = glb.document["animations"][0]["channels"];
             channels.erase(channels.size() - 1);
             glb.document["nodes"][static_cast<size_t>(body)]["translation"] = {0, 0.12, 0};
           },
           NamesOf(kHumanIkRig), Lying),
       "", Lying, "its body lies"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    const Read read = ReadBytes(row.file, row.bytes, Options(row.options));
    const Wrong wrong = Compare(read.motion, row.right);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
}

TEST_F(CasesTest, AGltfThatIsText) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  WriteFile(folder_ / "the dance.bin", glb.binary);
  glb.document["buffers"][0]["uri"] = "the%20dance.bin";
  EXPECT_LT(Compare(ReadBytes("a.gltf", glb.document.dump()).motion, Expressive).turns, kOpen);
  std::filesystem::remove(folder_ / "the dance.bin");
  ExpectError(ErrorCode::kInvalidArgument,
              "a.gltf: buffers[0].uri: \"the%20dance.bin\" is no file beside it: export it as .glb",
              [&] { ReadFile("a.gltf"); });
  for (const char* elsewhere : {"../the dance.bin", "/etc/passwd"}) {
    glb.document["buffers"][0]["uri"] = elsewhere;
    ExpectError(ErrorCode::kInvalidArgument, "is no file beside it",
                [&] { ReadBytes("a.gltf", glb.document.dump()); });
  }
  // Four bytes of time, which are 0.
  glb.document["buffers"][0] = {{"byteLength", 4},
                                {"uri", "data:application/octet-stream;base64,AAAAAA=="}};
  ExpectError(ErrorCode::kInvalidArgument, "reaches beyond its buffer of 4 bytes",
              [&] { ReadBytes("a.gltf", glb.document.dump()); });
}

/// A body that steps, as SMPL's arrays have it.
struct Arrays {
  Motion motion;
  std::vector<double> poses, trans;  ///< of 24 joints, Z up

  Arrays() {
    motion.fps = 30;
    for (int frame = 0; frame < 20; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.left_shoulder) << 0, 0.02 * frame, -1.2;
      pose.rotations.col(kSmpl.right_shoulder) << 0, 0, 1.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      poses.insert(poses.end(), amass.rotations.data(), amass.rotations.data() + 72);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  NpyArray Poses(std::vector<int64_t> rest,
                 const std::function<std::vector<double>(const Eigen::Vector3d&)>& state) const {
    std::vector<double> all;
    for (size_t i = 0; i < poses.size(); i += 3) {
      const std::vector<double> values = state({poses[i], poses[i + 1], poses[i + 2]});
      all.insert(all.end(), values.begin(), values.end());
    }
    rest.insert(rest.begin(), 20);
    return {rest, all};
  }
  NpyArray Trans() const { return {{20, 3}, trans}; }
};

TEST_F(CasesTest, TheLogOfArrays) {
  const Arrays smpl;
  const NpyArray rate{{}, std::vector<double>{30}};
  const auto vector = [](const Eigen::Vector3d& turn) {
    return std::vector<double>{turn.begin(), turn.end()};
  };
  const auto quaternion = [](bool real_first) {
    return [real_first](const Eigen::Vector3d& turn) {
      const Eigen::Quaterniond q(ExpMap(turn));
      return real_first ? std::vector<double>{q.w(), q.x(), q.y(), q.z()}
                        : std::vector<double>{-q.x(), -q.y(), -q.z(), -q.w()};
    };
  };
  struct ArrayRow {
    const char* name;
    NpyArray poses;
    const char* says = "";
    const char* options = "";
  };
  const auto scaled = [](double body, double root) {
    // The root, as AMASS has it, is turned by a quarter.
    return [=](const Eigen::Vector3d& turn) {
      const Eigen::Vector3d all = turn * (turn.norm() > 1.5 ? root : body);
      return std::vector<double>{all.begin(), all.end()};
    };
  };
  for (const ArrayRow& row : std::vector<ArrayRow>{
           {"quaternions, x first", smpl.Poses({24, 4}, quaternion(false))},
           {"quaternions, w first", smpl.Poses({24, 4}, quaternion(true))},
           {"flat quaternions", smpl.Poses({96}, quaternion(true))},
           {"6D, two columns beside each other", smpl.Poses({24, 3, 2},
                                                            [](const Eigen::Vector3d& turn) {
                                                              const Eigen::Matrix3d m =
                                                                  ExpMap(turn);
                                                              return std::vector<double>{
                                                                  m(0, 0), m(0, 1), m(1, 0),
                                                                  m(1, 1), m(2, 0), m(2, 1)};
                                                            })},
           {"degrees", smpl.Poses({72}, scaled(kDegrees, kDegrees)),
            "its poses are taken as degrees, not radians; --angles radians"},
           {"degrees, told", smpl.Poses({72}, scaled(kDegrees, kDegrees)), "", "--angles degrees"},
           {"radians of a root that spins on",
            smpl.Poses({72}, scaled(1, 1 + 8 * M_PI / (M_PI / 2))),
            "its root alone turns by more than two whole turns: its poses are taken as radians"},
           {"the same, told", smpl.Poses({72}, scaled(1, 1 + 8 * M_PI / (M_PI / 2))), "",
            "--angles radians"},
       }) {
    SCOPED_TRACE(row.name);
    NpzArchive npz;
    npz.SetArray("poses", row.poses);
    npz.SetArray("trans", smpl.Trans());
    npz.SetArray("fps", rate);
    const Read read = ReadNpz(npz, Options(row.options));
    EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
  NpzArchive npz;
  npz.SetArray("poses", smpl.Poses({72}, vector));
  npz.SetArray("trans", smpl.Trans());
  npz.SetText("fps", "30");
  EXPECT_EQ(ReadNpz(npz).motion.fps, 30);
  npz.SetText("fps", "many");
  ExpectError(ErrorCode::kInvalidArgument, "fps: \"many\" is no number; --fps says one",
              [&] { ReadNpz(npz); });
  EXPECT_EQ(ReadNpz(npz, {.fps = 25}).motion.fps, 25);
  // Two rates that differ are said, and --fps decides.
  npz.SetArray("fps", rate);
  npz.SetArray("mocap_frame_rate", {{}, std::vector<double>{120}});
  const Read two = ReadNpz(npz);
  EXPECT_EQ(two.motion.fps, 120);
  EXPECT_TRUE(two.Says("states mocap_frame_rate 120, fps 30: 120 frames a second is taken, --fps"))
      << Said(two);
  EXPECT_EQ(ReadNpz(npz, {.fps = 30}).motion.fps, 30);
  EXPECT_TRUE(ReadNpz(npz, {.fps = 30}).notes.empty());
  // Degrees so small that they may be radians bend knees as none can.
  npz.SetArray("poses", smpl.Poses({72}, scaled(20, 1)));
  EXPECT_TRUE(ReadNpz(npz, {.fps = 30, .angles = "radians"}).Says("--angles says the unit"));
  npz.SetArray("poses", smpl.Poses({24, 4}, [](const Eigen::Vector3d&) {
    return std::vector<double>{1, 1, 0, 0};
  }));
  ExpectError(ErrorCode::kInvalidArgument, "poses[0][0]: is no quaternion of length 1",
              [&] { ReadNpz(npz); });
  NpyArray lost = smpl.Poses({72}, vector);
  std::get<std::vector<double>>(lost.values)[72 * 7] = NAN;
  npz.SetArray("poses", lost);
  ExpectError(ErrorCode::kInvalidArgument,
              "poses: holds values that are not finite, first in frame 7 of 20",
              [&] { ReadNpz(npz); });
  npz.SetArray("poses", smpl.Poses({24, 4}, quaternion(true)));
  ExpectError(ErrorCode::kInvalidArgument, "--angles: is for rotation vectors, which its poses are",
              [&] { ReadNpz(npz, {.angles = "degrees"}); });
  ExpectError(ErrorCode::kInvalidArgument, "--angles: \"turns\" is none of degrees, radians",
              [&] { ReadNpz(npz, {.angles = "turns"}); });
  WriteFile(folder_ / "a.npz", "PK\5\6" + std::string(18, '\0'));  // a zip of nothing
  ExpectError(ErrorCode::kInvalidArgument,
              "(it has: nothing): write rotations and places by numpy.savez",
              [&] { ReadFile("a.npz"); });
}

TEST_F(CasesTest, ADictThatNumpySaved) {
  const Arrays smpl;
  const NpyArray poses{{20, 72}, smpl.poses}, rate{{}, std::vector<double>{30}};
  WritePickle(folder_ / "a.pkl", {{"poses", poses}, {"trans", smpl.Trans()}, {"fps", rate}});
  const std::string pickle = choreo::ReadFile(folder_ / "a.pkl");
  const std::string npy = JoinNpy({.descr = "|O", .shape = {}, .values = pickle});
  EXPECT_LT(WorstJoint(smpl.motion, ReadBytes("a.npy", npy).motion), 1e-6);
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npy: holds one array and does not say of what, as rows of 135, ",
              [&] { ReadBytes("a.npy", SerializeNpy(poses)); });
}

TEST_F(CasesTest, ReadsJointPositionsAlone) {
  const Arrays smpl;
  std::vector<double> places;
  for (const Pose& pose : smpl.motion.frames) {
    const Eigen::Matrix3Xd at = JointPositions(kSmpl, pose);
    places.insert(places.end(), at.data(), at.data() + 66);
  }
  const NpyArray joints{{20, 22, 3}, places};
  NpzArchive npz;
  npz.SetArray("joints", joints);
  npz.SetArray("fps", {{}, std::vector<double>{20}});
  npz.Write(folder_ / "a.npz");
  const Read named = ReadFile("a.npz"),
             bare = ReadBytes("a.npy", SerializeNpy(joints), {.fps = 20});
  for (const Read& read : {named, bare}) {
    EXPECT_EQ(read.motion.fps, 20);
    EXPECT_TRUE(read.Says("joints alone do not say")) << Said(read);
    ASSERT_EQ(read.motion.frames.size(), 20U);
    const Eigen::Matrix3Xd ours = JointPositions(kSmpl, read.motion.frames[10]),
                           theirs = JointPositions(kSmpl, smpl.motion.frames[10]);
    EXPECT_LT((ours - theirs).colwise().norm().head(22).maxCoeff(), 0.03);
  }
  EXPECT_TRUE(ReadBytes("a.npy", SerializeNpy(joints)).Says("states no rate; taken as 30"));
}

TEST_F(CasesTest, OtherFormatsGetAdvice) {
  for (const auto& [name, way] :
       {std::pair("a.fbx", "Blender imports it, and exports .glb"),
        std::pair("a.vrm", "its motions are .vrma"), std::pair("a.C3D", "solve them to .bvh")}) {
    ExpectError(ErrorCode::kInvalidArgument, way, [&] { ReadFile(name); });
  }
}

}  // namespace choreo::log_test
