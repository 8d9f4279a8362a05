#include "client/cli/report/written_dance.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace choreo::cli::written_dance_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

client::Header HeaderAt(double fps, int64_t first_frame = 0) {
  client::Header header;
  header.skeleton = Body();
  header.fps = fps;
  header.model_fps = 30;
  header.first_frame = first_frame;
  return header;
}

/// A dancer who slides: 1 cm a frame.
Motion Slide(double fps, int frames) {
  Motion motion{.fps = fps,
                .frames = std::vector<Pose>(static_cast<size_t>(frames), RestPose(Body()))};
  for (size_t i = 0; i < motion.frames.size(); ++i)
    motion.frames[i].root_position.x() = 0.01 * static_cast<double>(i);
  return motion;
}

client::KeyPose KeyAt(int64_t frame, double x) {
  client::KeyPose key{.id = "a", .frame = frame, .pose = RestPose(Body())};
  key.pose.root_position.x() = x;
  return key;
}

/// According to the server, the key is hit.
client::Report Hit(int64_t frame) {
  client::Report report;
  report.keys.push_back({.id = "a", .frame = frame});
  return report;
}

TEST(WrittenDanceTest, MeasuresAKeyInTheMotion) {
  const WrittenDance dance = Examine(HeaderAt(30), Hit(20), Slide(30, 60), {KeyAt(20, 0.2)});
  ASSERT_EQ(dance.keys.size(), 1U);
  EXPECT_EQ(dance.keys.at(20).in_file->frame, 20);
  EXPECT_TRUE(dance.keys.at(20).in_file->on_frame);
  EXPECT_NEAR(dance.keys.at(20).in_file->error.position_m, 0, 1e-9);
  CheckKeys(dance);
}

TEST(WrittenDanceTest, MeasuresKeysDespiteTheReport) {
  const WrittenDance dance = Examine(HeaderAt(30), Hit(20), Slide(30, 60), {KeyAt(20, 0.205)});
  ExpectError(ErrorCode::kInternal, "a: was missed by 5 mm", [&] { CheckKeys(dance); });
  ExpectError(ErrorCode::kInternal, "b: the dance has no such key pose", [&] {
    client::KeyPose other = KeyAt(20, 0.2);
    other.id = "b";
    Examine(HeaderAt(30), Hit(20), Slide(30, 60), {other});
  });
}

TEST(WrittenDanceTest, CountsFromTheFirstFrameAtTheFilesRate) {
  // The dance begins at frame 15 = 0.5 s; the key at frame 61 = 2 1/30 s.
  for (const auto& [fps, frame, on_frame] : {std::tuple(30.0, int64_t{46}, true),
                                             {60.0, int64_t{92}, true},
                                             {24.0, int64_t{37}, false}}) {
    const WrittenDance dance =
        Examine(HeaderAt(fps, 15), Hit(61), Slide(fps, 100), {KeyAt(61, 0.01 * frame)});
    EXPECT_EQ(dance.keys.at(61).in_file->frame, frame) << fps;
    EXPECT_EQ(dance.keys.at(61).in_file->on_frame, on_frame) << fps;
    EXPECT_NEAR(dance.keys.at(61).in_file->error.position_m, 0, 1e-9) << fps;
  }
}

TEST(WrittenDanceTest, UsesTheReportBetweenFrames) {
  client::Report report = Hit(61);
  // Nothing in the file is at the key's time: how far its nearest frame is off is no miss.
  CheckKeys(Examine(HeaderAt(24), report, Slide(24, 100), {KeyAt(61, 0.3)}));
  report.keys[0].final_error_m = 0.002;
  ExpectError(ErrorCode::kInternal, "a: was missed by 2 mm",
              [&] { CheckKeys(Examine(HeaderAt(24), report, Slide(24, 100), {KeyAt(61, 0.3)})); });
}

TEST(WrittenDanceTest, ChanceIsTheShareOfFramesNearABeat) {
  EXPECT_FALSE(BeatHitChance({}, 100, 30).has_value());
  EXPECT_DOUBLE_EQ(*BeatHitChance({1.0}, 100, 30), 0.05);              // frames 28 to 32
  EXPECT_DOUBLE_EQ(*BeatHitChance({1.0, 1.1}, 100, 30), 0.08);         // 28 to 35
  EXPECT_DOUBLE_EQ(*BeatHitChance({0.0, 3.3}, 100, 30), 0.03 + 0.03);  // 0 to 2, 97 to 99
}

}  // namespace choreo::cli::written_dance_test
