#include "client/authoring/keys/choreography.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::authoring::choreography_test {

std::vector<double> EvenBeats(double first, double period, int count) {
  std::vector<double> beats;
  for (int i = 0; i < count; ++i) beats.push_back(first + period * i);
  return beats;
}

/// What follows the number in a key's id.
std::string PoseOf(const client::KeyPose& key) { return key.id.substr(key.id.find('-') + 1); }

TEST(ChoreographyTest, PutsKeysOnBeats) {
  const auto beats = EvenBeats(0.3, 0.5, 60);
  const auto keys = ComposeKeys({.seconds = 24, .beats = beats, .seed = 5}, PoseLibrary());
  ASSERT_GE(keys.size(), 8U);
  EXPECT_EQ(keys[0].time_s, 0);
  for (size_t i = 1; i < keys.size(); ++i) {
    EXPECT_NE(std::find(beats.begin(), beats.end(), keys[i].time_s), beats.end()) << keys[i].time_s;
    EXPECT_NEAR(keys[i].time_s - keys[i - 1].time_s, i == 1 ? 2.3 : 2.0, 1e-9);
    EXPECT_LT(keys[i].time_s, 24);
  }
}

TEST(ChoreographyTest, PutsKeysOnCountOneAndThoseThatFollowIt) {
  for (const size_t one : {0, 1, 3, 6}) {
    const auto beats = EvenBeats(0.3, 0.5, 60);
    const auto keys =
        ComposeKeys({.seconds = 24, .beats = beats, .one = one, .seed = 5}, PoseLibrary());
    ASSERT_GE(keys.size(), 8U);
    for (size_t i = 1; i < keys.size(); ++i) {
      const double count = (keys[i].time_s - beats[one]) / 0.5;
      EXPECT_NEAR(count, 4 * std::round(count / 4), 1e-6) << one;
    }
  }
}

TEST(ChoreographyTest, BeginsWithNoEnding) {
  const std::vector<LibraryPose> poses = PosesToDance(Skeleton::Smpl24());
  ASSERT_EQ(std::ranges::count_if(poses, IsEnding), 2) << "bow and curtsey";
  std::set<std::string> first;
  for (uint64_t seed = 0; seed < 500; ++seed)
    first.insert(PoseOf(ComposeKeys({.seconds = 2, .seed = seed}, poses).front()));
  EXPECT_EQ(first.size(), poses.size() - 2);
  EXPECT_FALSE(first.contains("bow") || first.contains("curtsey"));
}

TEST(ChoreographyTest, FollowsAGivenPath) {
  // The library's poses stand elsewhere about the origin; these stand on it.
  std::vector<LibraryPose> poses(PoseLibrary().begin(), PoseLibrary().begin() + 6);
  for (LibraryPose& pose : poses) pose.pose.root_position = {0, 0.9, 0};
  const auto one = ComposeKeys({.seconds = 24, .seed = 5}, poses);
  const auto other = ComposeKeys({.seconds = 24, .seed = 6, .way = 5}, poses);
  ASSERT_EQ(one.size(), other.size());
  bool differs = false;
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pose.root_position, other[i].pose.root_position);
    differs = differs || PoseOf(one[i]) != PoseOf(other[i]);
  }
  EXPECT_TRUE(differs);
}

TEST(ChoreographyTest, CountsBeforeTheFirstBeatAndWithoutBeats) {
  const auto late =
      ComposeKeys({.seconds = 12, .beats = EvenBeats(6, 0.5, 12), .seed = 5}, PoseLibrary());
  EXPECT_GE(late.size(), 5U);
  const auto silent = ComposeKeys({.seconds = 12, .beats = {}, .seed = 5}, PoseLibrary());
  EXPECT_EQ(silent.size(), 6U);
}

TEST(ChoreographyTest, PutsNoKeyAfterTheLastFrame) {
  // The beat of 8.8889 s and the end of 8.889 s are the same frame.
  const auto beats = EvenBeats(0, 1.0 / 2.25, 40);
  const auto keys = ComposeKeys({.seconds = 8.889, .beats = beats, .seed = 5}, PoseLibrary());
  EXPECT_LE(std::lround(keys.back().time_s * 30), std::lround(8.889 * 30) - 1);
}

TEST(ChoreographyTest, EndsInAPoseOnRequest) {
  for (const double end_s : {1.97, 9.97, 10.0, 11.0, 11.3, 12.5, 13.97}) {
    for (const bool beats : {false, true}) {
      CompositionRequest request{.seconds = end_s + 0.04, .seed = 5, .end_s = end_s};
      if (beats) request.beats = EvenBeats(0.3, 0.5, static_cast<int>(2 * end_s));
      const auto keys = ComposeKeys(request, PoseLibrary());
      EXPECT_EQ(keys.back().time_s, end_s);
      for (size_t i = 1; i < keys.size(); ++i) {
        EXPECT_GE(keys[i].time_s - keys[i - 1].time_s, 1.2) << end_s;
        EXPECT_LE(keys[i].time_s - keys[i - 1].time_s, 3.5) << end_s;
      }
    }
  }
}

TEST(ChoreographyTest, LeavesTimeBetweenKeysAtAnyTempo) {
  for (const double period : {0.2, 0.33, 0.44, 0.7, 1.1, 1.9}) {
    const auto keys = ComposeKeys(
        {.seconds = 30, .beats = EvenBeats(0.1, period, static_cast<int>(30 / period)), .seed = 1},
        PoseLibrary());
    ASSERT_GE(keys.size(), 4U) << period;
    for (size_t i = 1; i < keys.size(); ++i) {
      EXPECT_GE(keys[i].time_s - keys[i - 1].time_s, 1.2) << period;
      EXPECT_LE(keys[i].time_s - keys[i - 1].time_s, 2 * 3.8) << period;
    }
  }
}

TEST(ChoreographyTest, NeverRepeatsAPoseAtOnceAndDancesThemAll) {
  std::set<std::string> danced;
  const auto keys = ComposeKeys({.seconds = 130, .beats = {}, .seed = 11}, PoseLibrary());
  for (size_t i = 0; i < keys.size(); ++i) {
    danced.insert(PoseOf(keys[i]));
    if (i > 0) {
      EXPECT_NE(PoseOf(keys[i]), PoseOf(keys[i - 1]));
    }
  }
  EXPECT_EQ(danced.size(), PoseLibrary().size());
}

TEST(ChoreographyTest, ReturningPartsRepeatTheirPoses) {
  CompositionRequest request{.seconds = 60, .beats = EvenBeats(0, 0.5, 120), .seed = 4};
  const auto without = ComposeKeys(request, PoseLibrary());
  request.passages = {{.from = 32, .to = 44, .like = 8.1}};
  const auto keys = ComposeKeys(request, PoseLibrary());
  ASSERT_EQ(keys.size(), 30U);
  int alike = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    const bool returns = keys[i].time_s >= 32 && keys[i].time_s < 44;
    if (returns) {
      EXPECT_EQ(PoseOf(keys[i]), PoseOf(keys[i - 12])) << keys[i].time_s;
    }
    if (i < 16) {
      EXPECT_EQ(keys[i].id, without[i].id);  // nothing has returned yet
    }
    alike += keys[i].id == without[i].id;
  }
  EXPECT_LT(alike, 30);
  std::vector<double> times;
  for (const client::KeyPose& key : keys) times.push_back(key.time_s);
  const std::vector<size_t> drawn = DrawPoses(times, request.passages, 4, PoseLibrary());
  for (size_t i = 16; i < 22; ++i) EXPECT_EQ(drawn[i], drawn[i - 12]);
  EXPECT_EQ(std::set<size_t>(drawn.begin(), drawn.end()).size(), 24U);
}

// Passages begin where the sound does, keys on the beat before.
TEST(ChoreographyTest, KeysJustBeforeAReturnRepeatToo) {
  const std::vector<double> times = {8, 10, 12, 30, 32, 34, 36};
  const std::vector<Passage> passages = {{.from = 32.6, .to = 40, .like = 8.6}};
  for (uint64_t seed = 0; seed < 50; ++seed) {
    // Of few poses, the one before the return would often be the same.
    const std::vector<size_t> drawn =
        DrawPoses(times, passages, seed, std::span(PoseLibrary()).first(3));
    for (size_t i = 4; i < 7; ++i) EXPECT_EQ(drawn[i], drawn[i - 4]) << seed;
    for (size_t i = 1; i < 5; ++i) EXPECT_NE(drawn[i], drawn[i - 1]) << seed;
  }
}

TEST(ChoreographyTest, WalksAtALeisurelyPaceOnTheStage) {
  const auto keys = ComposeKeys({.seconds = 300, .beats = {}, .seed = 2}, PoseLibrary());
  double furthest = 0;
  for (size_t i = 1; i < keys.size(); ++i) {
    const Eigen::Vector3d step = keys[i].pose.root_position - keys[i - 1].pose.root_position;
    // Poses lean up to 15 cm off their place.
    EXPECT_LE(std::hypot(step.x(), step.z()), 0.28 * 2 + 0.35);
    furthest = std::max(furthest,
                        std::hypot(keys[i].pose.root_position.x(), keys[i].pose.root_position.z()));
    EXPECT_EQ(keys[i].pose.root_position.y(),
              FindLibraryPose(PoseOf(keys[i])).pose.root_position.y());
  }
  EXPECT_GT(furthest, 0.6);
  EXPECT_LT(furthest, 2.0);
}

TEST(ChoreographyTest, MovesAPoseWithoutChangingIt) {
  for (const client::KeyPose& key :
       ComposeKeys({.seconds = 40, .beats = {}, .seed = 9}, PoseLibrary())) {
    const Pose& source = FindLibraryPose(PoseOf(key)).pose;
    const Eigen::MatrixXd moved = key.pose.rotations.rightCols(23);
    EXPECT_EQ(moved, source.rotations.rightCols(23)) << key.id;
  }
}

TEST(ChoreographyTest, DependsOnTheSeedAlone) {
  const auto compose = [](uint64_t seed) {
    return ComposeKeys({.seconds = 20, .beats = {}, .seed = seed}, PoseLibrary());
  };
  const auto a = compose(3);
  const auto b = compose(3);
  const auto c = compose(4);
  ASSERT_EQ(a.size(), b.size());
  bool differs = false;
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].pose.root_position, b[i].pose.root_position);
    differs = differs || a[i].id != c[i].id;
  }
  EXPECT_TRUE(differs);
}

TEST(ChoreographyTest, RefusesADanceThatIsTooShort) {
  ExpectError(ErrorCode::kInvalidArgument, "seconds: ", [] {
    ComposeKeys({.seconds = 1, .beats = {}, .seed = 0}, PoseLibrary());
  });
}

}  // namespace choreo::authoring::choreography_test
