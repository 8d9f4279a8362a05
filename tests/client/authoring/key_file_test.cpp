#include "client/authoring/keys/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "client/convert.h"
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
  refused("keys", "keys.json: is not JSON: cannot be read at line 1, column 1, \"keys\"");
  refused("\x89PNG\r\n\x1a\n", "keys.json: is not JSON, nor any text");
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

// Reading, copying or printing level by level would run out of stack.
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

}  // namespace choreo::authoring::key_file_test
