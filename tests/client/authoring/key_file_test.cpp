#include "client/authoring/keys/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_faults.h"
#include "client/convert.h"
#include "model/formats/containers/npz.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::authoring::key_file_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// 24 rotations, the last one given.
std::string Rotations(const std::string& last = "[0, 0, 0]", int joints = 24) {
  std::string text = "[";
  for (int joint = 0; joint + 1 < joints; ++joint)
    text += "[0.1, 0.2, " + std::to_string(joint) + "e-2], ";
  return text + last + "]";
}

std::string File(const std::string& members) { return R"({"keyframes": [{)" + members + "}]}"; }

std::string Key(const std::string& rotations = Rotations(), const std::string& more = "") {
  return File(R"("id": "a", "time": 2.0, "root_position": [1, 0.9, -2], "rotations": )" +
              rotations + more);
}

std::vector<client::KeyPose> Parse(const std::string& text) {
  return ParseKeyFile(text, "keys.json", Body());
}

TEST(KeyFileTest, ReadsAKeyAsItIsWritten) {
  const auto keys = Parse(Key());
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].id, "a");
  EXPECT_EQ(keys[0].time_s, 2.0);
  EXPECT_FALSE(keys[0].frame.has_value());
  EXPECT_EQ(keys[0].pose.root_position, Eigen::Vector3d(1, 0.9, -2));
  ASSERT_EQ(keys[0].pose.rotations.cols(), 24);
  EXPECT_EQ(keys[0].pose.rotations.col(7), Eigen::Vector3d(0.1, 0.2, 0.07));
  EXPECT_TRUE(keys[0].mask.root_position);
  EXPECT_TRUE(keys[0].mask.joints.empty());
}

// client/node and client/python have readers of their own; their tests compare them with this file.
TEST(KeyFileTest, PackagesReadTheSameKeys) {
  const std::filesystem::path source = SOURCE_FOLDER;
  const auto read = [](const std::filesystem::path& file) {
    return std::string(std::istreambuf_iterator<char>(std::ifstream(file).rdbuf()), {});
  };
  const auto known = nlohmann::json::parse(read(source / "tests/examples/read_keys.json"));
  EXPECT_EQ(known.size(), 3U);
  for (const auto& [name, keys] : known.items()) {
    const auto mine = Parse(read(source / "examples" / name));
    ASSERT_EQ(mine.size(), keys.size()) << name;
    for (size_t i = 0; i < mine.size(); ++i) {
      SCOPED_TRACE(mine[i].id);
      const auto& key = keys[i];
      const v1::Keyframe sent = client::ToProto(mine[i]);
      EXPECT_EQ(sent.id(), key.at("id"));
      EXPECT_NEAR(sent.time(), key.value("time", 0.0), 1e-5);
      EXPECT_EQ(sent.frame(), key.value("frame", 0));
      EXPECT_EQ(sent.has_hit() ? sent.hit() : -1, key.value("hit", -1.0));
      EXPECT_EQ(v1::HandPose_Name(sent.hands()), key.value("hands", "HAND_POSE_UNSPECIFIED"));
      const auto& mask = sent.mask().joints();
      const auto joints = nlohmann::json(key.value("mask", nlohmann::json::object()))
                              .value("joints", std::vector<int>());
      EXPECT_EQ(std::vector<int>(mask.begin(), mask.end()), joints);
      const auto& pose = key.at("pose");
      EXPECT_EQ(sent.pose().has_root_position(), pose.contains("root_position"));
      if (const auto root = pose.find("root_position"); root != pose.end()) {
        EXPECT_NEAR(sent.pose().root_position().x(), root->at("x"), 1e-5);
        EXPECT_NEAR(sent.pose().root_position().y(), root->at("y"), 1e-5);
        EXPECT_NEAR(sent.pose().root_position().z(), root->at("z"), 1e-5);
      }
      const auto& rotations = sent.pose().rotations();
      EXPECT_THAT(std::vector<float>(rotations.begin(), rotations.end()),
                  testing::Pointwise(testing::FloatNear(1e-5F),
                                     pose.at("rotations").get<std::vector<float>>()));
    }
  }
}

TEST(KeyFileTest, KeepsTheOrderAndNamesUnnamedKeys) {
  const std::string nameless = R"({"frame": 90, "rotations": )" + Rotations() + "}";
  const auto keys = Parse(R"({"keyframes": [)" + nameless + "," +
                          R"({"id": "b", "time": 1, "rotations": )" + Rotations() + "}]}");
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].id, "key1");
  EXPECT_EQ(keys[0].frame, 90);
  EXPECT_EQ(keys[1].id, "b");
}

TEST(KeyFileTest, MasksOmittedFields) {
  const auto keys =
      Parse(File(R"("time": 1, "joints": ["left_elbow", "head"], "rotations": )" + Rotations()));
  EXPECT_FALSE(keys[0].mask.root_position);
  ASSERT_EQ(keys[0].mask.joints.size(), 24U);
  for (int joint = 0; joint < 24; ++joint) {
    const bool wanted = joint == Body().Find("left_elbow") || joint == Body().Find("head");
    EXPECT_EQ(keys[0].mask.joints[static_cast<size_t>(joint)], wanted) << joint;
  }
}

TEST(KeyFileTest, ErrorsNameTheFieldTheValueAndTheLimit) {
  const auto refused = [](const std::string& text, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { Parse(text); });
  };
  refused("{", "keys.json: is not JSON: ends too early at line 1, column 2");
  const std::string comma = "is not JSON: has an extra comma at line ";
  refused("{\"keyframes\": [{\"time\": 2, \"pose\": \"kick\",}]}", comma + "1, column 42");
  refused("{\"keyframes\": [{\"time\": 2},\n ]}", comma + "1, column 27");
  refused("[]", "keys.json: has no list \"keyframes\"");
  refused(R"({"keyframes": []})", "keys.json:keyframes: is empty");
  refused(R"({"keyframes": [3]})", "keyframes[0]: 3 is not an object");
  refused(Key(Rotations("[7, 3, 3]")), "keyframes[0].rotations[23]: 8.18535 rad exceeds 2π");
  refused(Key(Rotations("[0, 0]")), "keyframes[0].rotations[23]: [0,0] is not a list of 3 numbers");
  refused(Key(Rotations("[0, \"x\", 0]")), "keyframes[0].rotations[23][1]: \"x\" is not a number");
  refused(Key(Rotations("[0, 0, 0]", 23)),
          "keyframes[0].rotations: has 23 entries, not one for each of the 24 joints");
  refused(Key(Rotations(), R"(, "tiem": 3)"), "keyframes[0].tiem: is not known");
  refused(Key(Rotations(), R"(, "frame": 3)"), "keyframes[0].time: cannot be combined with frame");
  refused(File(R"("rotations": )" + Rotations()), "keyframes[0].time: is missing");
  refused(File(R"("time": -1, "rotations": )" + Rotations()),
          "keyframes[0].time: -1 s is before 0");
  refused(File(R"("frame": 1.5, "rotations": )" + Rotations()),
          "keyframes[0].frame: 1.5 is not a whole number");
  refused(File(R"("time": 1)"), "keyframes[0].rotations: is missing");
  refused(File(R"("time": 1, "joints": ["tail"], "rotations": )" + Rotations()),
          "\"tail\" is not a joint of smpl24");
  const std::string same = R"({"id": "a", "time": 1, "rotations": )" + Rotations() + "}";
  refused(R"({"keyframes": [)" + same + "," + same + "]}",
          "keyframes[1].id: \"a\" is already the id of an earlier key");
  refused(File(R"("frame": 18446744073709551615, "rotations": )" + Rotations()),
          "keyframes[0].frame: 18446744073709551615 is not a whole number from 0 to 1000000000");
  refused(File(R"("time": 1e300, "rotations": )" + Rotations()),
          "keyframes[0].time: 1e+300 s is beyond 1e+09 s");
  refused(Key(Rotations("[0, 1e999, 0]")),
          "keyframes[0].rotations[23][1]: 1e999 is beyond 1.8e308, the largest number");
}

// Reading, copying or printing level by level would run out of stack.
TEST(KeyFileTest, PackagesRefuseTheSameKeys) {
  std::ifstream file(std::filesystem::path(SOURCE_FOLDER) / "tests/examples/refused_keys.json");
  for (const auto& refused : nlohmann::json::parse(file)) {
    ExpectError(ErrorCode::kInvalidArgument, refused.at("said"),
                [&] { Parse(refused.at("file").dump()); });
  }
}

// client/node and client/python are tested with the same file.
TEST(KeyFileTest, PlacesAndTurnsAnyPose) {
  std::ifstream file(std::filesystem::path(SOURCE_FOLDER) / "tests/examples/placed_keys.json");
  for (const auto& placed : nlohmann::json::parse(file)) {
    SCOPED_TRACE(placed.dump());
    const v1::Keyframe sent = client::ToProto(Parse(placed.at("file").dump())[0]);
    EXPECT_EQ(sent.pose().has_root_position(), placed.contains("root"));
    if (placed.contains("root")) {
      const auto& root = sent.pose().root_position();
      EXPECT_THAT((std::vector<double>{root.x(), root.y(), root.z()}),
                  testing::Pointwise(testing::DoubleNear(1e-3),
                                     placed.at("root").get<std::vector<double>>()));
    }
    const auto& rotations = sent.pose().rotations();
    EXPECT_THAT(std::vector<float>(rotations.begin(), rotations.begin() + 3),
                testing::Pointwise(testing::FloatNear(1e-5F),
                                   placed.at("pelvis").get<std::vector<float>>()));
    const auto& mask = sent.mask().joints();
    EXPECT_EQ(std::vector<int>(mask.begin(), mask.end()),
              placed.at("joints").get<std::vector<int>>());
  }
}

TEST(KeyFileTest, RefusesWhatIsNestedTooDeeply) {
  const auto nested = [](size_t levels, const std::string& inner) {
    return std::string(levels, '[') + inner + std::string(levels, ']');
  };
  const auto key = [](const std::string& poses) {
    return File(R"("time": 1, "smpl_poses": )" + poses);
  };
  ExpectError(ErrorCode::kInvalidArgument, "keys.json: is JSON of more than 64 levels",
              [&] { Parse(key(nested(1'000'000, "0"))); });
  ExpectError(ErrorCode::kInvalidArgument, "keyframes[0].smpl_poses[0][0]: [0] is not a number",
              [&] { Parse(key(nested(3, "0"))); });
  // Brackets in texts are none.
  EXPECT_EQ(Parse(File(R"("id": "\"[[", "time": 1, "rotations": )" + Rotations()))[0].id, "\"[[");
  ExpectError(ErrorCode::kInvalidArgument, "smpl_poses: 3 is not a list", [&] { Parse(key("3")); });
}

// Turning Z up into Y up would make a small angle of any.
TEST(KeyFileTest, RefusesAbsurdAnglesAsTheyAreWritten) {
  const auto refused = [](double root, const std::string& part) {
    std::vector<double> poses(72, 0.1);
    poses[0] = root;
    ExpectError(ErrorCode::kInvalidArgument, part, [&] {
      Parse(File(R"("time": 1, "smpl_poses": )" + nlohmann::json(poses).dump()));
    });
  };
  refused(1e30, "keyframes[0].smpl_poses[0]: 1e+30 rad exceeds 2π");
  refused(7, "keyframes[0].smpl_poses[0]: 7.00143 rad exceeds 2π");
}

// Where SMPL's joints are, as its authors and EDGE define it, written down without our code: Z up,
// joints rotate about their places in a rest body whose pelvis is at `rest_pelvis`, and the
// translation moves it all. Then turned to Y up.
Eigen::Matrix3Xd SmplJoints(const std::vector<double>& poses, const Eigen::Vector3d& trans,
                            const Eigen::Vector3d& rest_pelvis) {
  Eigen::Matrix3Xd joints(3, 24);
  std::vector<Eigen::Matrix3d> global(24);
  for (int joint = 0; joint < 24; ++joint) {
    const Eigen::Vector3d w(poses[3 * joint], poses[3 * joint + 1], poses[3 * joint + 2]);
    const Eigen::Matrix3d local =
        w.isZero() ? Eigen::Matrix3d::Identity().eval()
                   : Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
    const int parent = Body().parents[joint];
    if (parent < 0) {
      joints.col(joint) = rest_pelvis + trans;
      global[joint] = local;
    } else {
      joints.col(joint) = joints.col(parent) + global[parent] * Body().offsets.col(joint);
      global[joint] = global[parent] * local;
    }
  }
  Eigen::Matrix3Xd y_up(3, 24);
  y_up << joints.row(0), joints.row(2), -joints.row(1);
  return y_up;
}

const Eigen::Vector3d kJ0(-0.00179506, -0.22333382, 0.02821918);

// A standing dancer in a Z-up world, every joint bent somehow.
std::vector<double> ZUpPose() {
  std::vector<double> poses(72);
  for (size_t i = 0; i < poses.size(); ++i) poses[i] = 0.4 * std::sin(1.7 * double(i) + 0.3);
  poses[0] += M_PI / 2;
  return poses;
}

TEST(KeyFileTest, TakesPosesOfEdgeAndAmass) {
  const std::vector<double> poses = ZUpPose();
  const Eigen::Vector3d trans(0.4, -1.2, 0.95);
  const std::string numbers = nlohmann::json(poses).dump();
  const std::string place = "[0.4, -1.2, 0.95]";
  struct Case {
    std::string members;
    Eigen::Vector3d rest_pelvis;
    int joints;  // that it gives
  };
  std::vector<double> smpl_h = poses;
  smpl_h.resize(156);
  for (size_t i = 66; i < 156; ++i) smpl_h[i] = 0.2;  // fingers
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < 72; i += 3) rows.push_back({poses[i], poses[i + 1], poses[i + 2]});
  for (const Case& one :
       {Case{R"("smpl_poses": )" + numbers + R"(, "smpl_trans": )" + place, Eigen::Vector3d::Zero(),
             24},
        Case{R"("smpl_poses": )" + nlohmann::json(rows).dump() + R"(, "smpl_trans": )" + place,
             Eigen::Vector3d::Zero(), 24},
        Case{R"("poses": )" + numbers + R"(, "trans": )" + place, kJ0, 24},
        Case{R"("poses": )" + nlohmann::json(smpl_h).dump() + R"(, "trans": )" + place, kJ0, 22}}) {
    const auto keys = Parse(File(R"("time": 1, )" + one.members));
    ASSERT_EQ(keys.size(), 1U);
    EXPECT_TRUE(keys[0].mask.root_position);
    const Eigen::Matrix3Xd expected = SmplJoints(poses, trans, one.rest_pelvis);
    const Eigen::Matrix3Xd ours = JointPositions(Body(), keys[0].pose);
    EXPECT_LT((ours - expected).leftCols(one.joints).cwiseAbs().maxCoeff(), 1e-12);
    // The head is above the hips: Z has become Y.
    EXPECT_GT(ours(1, Body().Find("head")), ours(1, 0) + 0.3);
  }
  const auto nowhere = Parse(File(R"("time": 1, "smpl_poses": )" + numbers));
  EXPECT_FALSE(nowhere[0].mask.root_position);

  const auto refused = [](const std::string& members, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part,
                [&] { Parse(File(R"("time": 1, )" + members)); });
  };
  refused(R"("smpl_poses": [1, 2, 3])",
          "keyframes[0]: smpl_poses: has the shape [1, 3], expected [frames, 72]");
  refused(R"("poses": [[0, 0, 0]])", "expected [frames, 72 or 156 or 165 or 66]");
  refused(R"("smpl_poses": )" + numbers + R"(, "smpl_trans": [0, 1])", "smpl_trans: has the shape");
  refused(R"("smpl_trans": [0, 1, 2])", "keyframes[0].smpl_poses: is missing beside smpl_trans");
  refused(R"("smpl_poses": )" + numbers + R"(, "rotations": )" + Rotations(),
          "keyframes[0].smpl_poses: cannot be combined with rotations");
  refused(R"("smpl_poses": )" + numbers + R"(, "root_position": [0, 1, 0])",
          "keyframes[0].rotations: is missing beside root_position");
  refused(R"("smpl_poses": [0, 0, "x"])", "keyframes[0].smpl_poses[2]: \"x\" is not a number");
  std::vector<double> absurd = poses;
  absurd[9] = 9;
  refused(R"("smpl_poses": )" + nlohmann::json(absurd).dump(), "smpl_poses[3]: 9.0");
}

// The same in files: `--keyframes FILE.npz@SECOND`.
TEST(KeyFileTest, TakesPosesOutOfFilesOfEdgeAndAmass) {
  const TemporaryFolder folder;
  std::vector<double> poses(72), trans = {0, 0, 0};
  const std::vector<double> bent = ZUpPose();
  poses.insert(poses.end(), bent.begin(), bent.end());
  trans.insert(trans.end(), {0.4, -1.2, 0.95});
  NpzArchive edge, amass;
  edge.SetArray("smpl_poses", {{2, 72}, poses});
  edge.SetArray("smpl_trans", {{2, 3}, trans});
  edge.Write(folder / "edge.npz");
  amass.SetArray("poses", {{2, 72}, poses});
  amass.SetArray("trans", {{2, 3}, trans});
  amass.SetArray("mocap_framerate", {{}, std::vector<double>{120}});
  amass.Write(folder / "amass.npz");
  const auto expect = [&](const std::string& source, const Eigen::Vector3d& rest_pelvis) {
    const auto keys = ReadKeys((folder / source).string(), Body());
    ASSERT_EQ(keys.size(), 1U);
    EXPECT_EQ(keys[0].time_s, 4);
    EXPECT_LT(
        (JointPositions(Body(), keys[0].pose) - SmplJoints(bent, {0.4, -1.2, 0.95}, rest_pelvis))
            .cwiseAbs()
            .maxCoeff(),
        1e-9);
  };
  expect("edge.npz@0.0333333333333=4", Eigen::Vector3d::Zero());
  expect("amass.npz@0.0083333333333=4", kJ0);
}

class MotionKeysTest : public testing::Test {
 protected:
  void SetUp() override {
    motion_.fps = 30;
    for (int frame = 0; frame <= 90; ++frame) {
      Pose pose = RestPose(Body());
      pose.root_position.x() = 0.01 * frame;
      pose.rotations(1, 0) = 0.02 * frame;
      motion_.frames.push_back(pose);
    }
    path_ = (folder_ / "walk.bvh").string();
    WriteMotion(path_, Body(), motion_);
  }

  TemporaryFolder folder_;
  Motion motion_;
  std::string path_;
};

TEST_F(MotionKeysTest, TakesPosesOutOfAMotion) {
  const auto keys = ReadKeys(path_ + "@1.2,2.5=8", Body());
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].id, "walk@1.2");
  EXPECT_EQ(keys[0].time_s, 1.2);
  EXPECT_LT(ComparePoses(Body(), keys[0].pose, motion_.frames[36]).position_m, 1e-5);
  EXPECT_EQ(keys[1].time_s, 8);
  EXPECT_LT(ComparePoses(Body(), keys[1].pose, motion_.frames[75]).position_m, 1e-5);
}

TEST_F(MotionKeysTest, TakesTheShortestWayAfterAnyNumberOfTurns) {
  // One and a half turns about the axis of a pirouette: the file's branch ends at 3 pi.
  for (size_t frame = 0; frame < motion_.frames.size(); ++frame)
    motion_.frames[frame].rotations(1, 0) = 3 * M_PI * static_cast<double>(frame) / 90;
  WriteMotion(path_, Body(), motion_);
  ASSERT_GT(ReadMotion(path_, Body()).frames.back().rotations.col(0).norm(), 2.9 * M_PI);
  for (const client::KeyPose& key : ReadKeys(path_ + "@0,1.9,2.5,3", Body())) {
    EXPECT_LE(key.pose.rotations.colwise().norm().maxCoeff(), M_PI + 1e-9) << key.id;
    const auto frame = static_cast<size_t>(std::lround(30 * key.time_s));
    EXPECT_LT(ComparePoses(Body(), key.pose, motion_.frames[frame]).position_m, 1e-5) << key.id;
  }
}

TEST_F(MotionKeysTest, RefusesInvalidTimes) {
  for (const char* times : {"", "x", "1,", "-1", "1.2x", "1=", "nan"}) {
    ExpectError(ErrorCode::kInvalidArgument, path_ + "@" + times,
                [&] { ReadKeys(path_ + "@" + times, Body()); });
  }
  ExpectError(ErrorCode::kInvalidArgument, "second 3.5 is after the motion's end at 3",
              [&] { ReadKeys(path_ + "@3.5", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "name its poses", [&] { ReadKeys(path_, Body()); });
  ExpectError(ErrorCode::kNotFound, "absent.json", [&] { ReadKeys("absent.json", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "is a folder, not a key file",
              [&] { ReadKeys(folder_.path().string(), Body()); });
}

TEST(KeyFileTest, TakesOneKeyOfAFile) {
  const TemporaryFolder folder;
  const std::string path = (folder / "keys.json").string();
  std::ofstream(path) << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "hold": 0.4},
    {"id": "walk@1.2", "time": 3, "pose": "kick"}]})";
  std::vector<std::string> places;
  const auto held = ReadKeys(path + "@a", Body(), &places);
  EXPECT_EQ(held.size(), 3U);
  EXPECT_EQ(places, (std::vector{path + ":keyframes[0]", path + ":keyframes[0].hold",
                                 path + ":keyframes[0].hold"}));
  EXPECT_EQ(FileOf(path + "@walk@1.2").string(), path);
  const auto one = ReadKeys(path + "@walk@1.2", Body(), &places);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].id, "walk@1.2");
  EXPECT_EQ(places.front(), path + ":keyframes[1]");
  ExpectError(ErrorCode::kInvalidArgument, "has no key \"a held 1\"; it has a, walk@1.2",
              [&] { ReadKeys(path + "@a held 1", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "has no key \"walk@1.3\"; did you mean walk@1.2?",
              [&] { ReadKeys(path + "@walk@1.3", Body()); });
}

TEST(KeyFileTest, SaysHowHardAKeyIsHit) {
  const auto read = [](const std::string& more) {
    return ParseKeyFile(R"({"keyframes": [{"time": 1, "pose": "stand")" + more + "}]}", "k.json",
                        Body());
  };
  EXPECT_FALSE(read("").front().hit);
  const auto held = read(R"(, "hit": 2.5, "hold": 0.4)");
  ASSERT_EQ(held.size(), 3U);
  EXPECT_EQ(held[0].hit, 2.5);
  EXPECT_FALSE(held[1].hit);
  EXPECT_EQ(client::ToProto(held[0]).hit(), 2.5);
  ExpectError(ErrorCode::kInvalidArgument,
              "k.json:keyframes[0].hit: 4 is not a number from 0 (gently) to 3 (late and fast)",
              [&] { read(R"(, "hit": 4)"); });
}

TEST(KeyFileTest, TimesAreAlsoCountsOfTheMusic) {
  const Counts counts = CountsFrom({0.5, 1, 1.5, 2}, {});
  const std::string text =
      R"({"keyframes": [{"time": "3c", "hold": "2 counts", "pose": "stand"}]})";
  const auto keys = ParseKeyFile(text, "k.json", Body(), nullptr, counts);
  EXPECT_EQ(keys.front().time_s, 1.5);
  EXPECT_EQ(keys.back().time_s, 2.5);
  ExpectError(ErrorCode::kInvalidArgument,
              "k.json:keyframes[0].time: 3c: counts need music that has beats",
              [&] { ParseKeyFile(text, "k.json", Body()); });
}

TEST(KeyFileTest, SaysWhatHandsDo) {
  const auto read = [](const std::string& more) {
    return ParseKeyFile(R"({"keyframes": [{"time": 1, "pose": "stand")" + more + "}]}", "k.json",
                        Body());
  };
  EXPECT_FALSE(read("").front().hands);
  EXPECT_EQ(client::ToProto(read("").front()).hands(), v1::HAND_POSE_UNSPECIFIED);
  const auto held = read(R"(, "hands": "fist", "hold": 0.4)");
  ASSERT_EQ(held.size(), 3U);
  for (const client::KeyPose& key : held) EXPECT_EQ(key.hands, HandPose::kFist);
  EXPECT_EQ(client::ToProto(held[0]).hands(), v1::HAND_POSE_FIST);
  for (const char* wrong : {"\"claw\"", "3"}) {
    ExpectError(ErrorCode::kInvalidArgument,
                std::string("k.json:keyframes[0].hands: ") + wrong +
                    " is none of rest, relaxed, open, fist, point",
                [&] { read(std::string(", \"hands\": ") + wrong); });
  }
}

TEST_F(MotionKeysTest, ReadsAKeyFileByItsPath) {
  const std::string path = (folder_ / "odd@name.json").string();
  std::ofstream(path) << Key();
  EXPECT_EQ(ReadKeys(path, Body()).front().id, "a");
}

TEST(KeyFileTest, TheDemoBeginsQuicklyAndBowsLast) {
  const auto keys = ReadKeys(SOURCE_FOLDER "/examples/demo.json", Skeleton::Smpl24());
  EXPECT_TRUE(KeyFaults(keys, 30, Skeleton::Smpl24()).empty());
  EXPECT_EQ(keys.front().time_s, 0);
  EXPECT_LT(keys[1].time_s, 2);
  EXPECT_EQ(keys.back().id, "bow");
  EXPECT_LT(keys.back().time_s, 24);
}

TEST_F(MotionKeysTest, KeysOfADanceAreTooCloseInTheWordsOfTheirFile) {
  const auto refused = [&](const std::string& when, const std::string& message) {
    std::ofstream(folder_ / "close.json")
        << R"({"keyframes": [{"id": "b", "pose": "kick", )" + when;
    ExpectError(ErrorCode::kInvalidArgument, (folder_ / "close.json").string() + message, [&] {
      ReadDanceKeys({(folder_ / "close.json").string()}, {300, 30}, Body());
    });
  };
  refused(
      R"("time": 2.02}, {"id": "a", "pose": "bow", "time": 2}]})",
      ":keyframes[0].time: key \"b\" at 2.02 s is closer than 2 frames (0.067 s) to key \"a\" at "
      "2 s");
  refused(
      R"("frame": 61}, {"id": "a", "pose": "bow", "frame": 60}]})",
      ":keyframes[0].frame: key \"b\" at frame 61 is closer than 2 frames (0.067 s) to key \"a\" "
      "at frame 60");
}

// The last pose is in the air for too long, whatever the first one's name says.
TEST(KeyFileTest, AKeyHasNoFaultsOfOthersWithSimilarNames) {
  const Skeleton& body = Skeleton::Smpl24();
  Pose jump = RestPose(body);
  jump.root_position.y() += 0.4;
  const client::KeyPose key{.id = "b", .time_s = 1.5, .pose = jump};
  EXPECT_TRUE(KeyFaults(key, 45, 30, body, {{"from \"b\"", 1, jump}, {"c", 2.2, jump}}).empty());
}

TEST(KeyFileTest, TheWayFromAHeldKeyBeginsWhereItsHoldEnds) {
  const Skeleton& body = Skeleton::Smpl24();
  const Pose stand = RestPose(body);
  Pose low = stand;
  low.root_position.y() -= 0.6;
  const client::KeyPose plank{.id = "plank", .time_s = 2, .pose = low};
  const std::vector<TimedPose> around = {{"a", 1, stand}, {"up", 3.5, stand}};
  EXPECT_TRUE(KeyFaults(plank, 60, 30, body, around).empty());
  const auto faults = KeyFaults(plank, 90, 30, body, around);  // held for a second
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0].message,
              testing::HasSubstr("rise 0.6 m in 0.5 s from \"plank\" to \"up\""));
}

TEST(KeyFileTest, AJumpWithoutAPlaceIsWarnedOf) {
  const Skeleton& body = Skeleton::Smpl24();
  const auto faults = [&](const std::string& key) {
    const std::string text = R"({"keyframes": [{"time": 1, )" + key + "}]}";
    DanceKeys keys;
    keys.poses = ParseKeyFile(text, "keys.json", body, &keys.places);
    return KeyFaults(keys, 30, body);
  };
  const auto lost = faults(R"("id": "up", "pose": "star_jump")");
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].frame, 30);
  EXPECT_THAT(lost[0].message, testing::HasSubstr("key \"up\": the pose is 0."));
  EXPECT_THAT(lost[0].message, testing::HasSubstr("\"place\": [x, z]"));
  EXPECT_TRUE(faults(R"("pose": "star_jump", "place": [0, 0])").empty());
  EXPECT_TRUE(faults(R"("pose": "crouch")").empty());
  EXPECT_TRUE(faults(R"("joints": {"left_knee": 90})").empty());
}

}  // namespace choreo::authoring::key_file_test
