#include "model/metrics/style_classifier.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/core/numbers/random.h"
#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::style_classifier_test {

using testing_support::Wave;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Half a minute of a dancer who swings an arm (style 0), a leg (1) or the head (2).
CriticWindows Dance(uint64_t seed, size_t style) {
  constexpr int kMoving[] = {16, 1, 15};
  Random random(seed);
  std::vector<Pose> poses(900, RestPose(Body()));
  const double hz = random.Uniform(0.5, 1.5);
  for (size_t t = 0; t < poses.size(); ++t) {
    poses[t].rotations(0, kMoving[style]) = 0.4 * Wave(hz, static_cast<double>(t) / 30);
    for (int joint = 0; joint < Body().joints(); ++joint)
      poses[t].rotations(1, joint) = 0.01 * random.Normal();
  }
  CriticWindows windows;
  windows.Add(TrackJoints(Body(), poses), 30, style);
  return windows;
}

CriticWindows Dances(uint64_t seed) {
  CriticWindows all;
  for (size_t style = 0; style < 3; ++style) {
    // One style has been seen more often.
    for (uint64_t i = 0; i < (style == 0 ? 4U : 2U); ++i) {
      const CriticWindows dance = Dance(seed + 10 * style + i, style);
      std::ranges::copy(dance.features, std::back_inserter(all.features));
      std::ranges::copy(dance.clips, std::back_inserter(all.clips));
    }
  }
  return all;
}

TEST(StyleClassifier, ClassifiesUnseenDancers) {
  const StyleClassifier classifier(Dances(1), 3);
  for (size_t style = 0; style < 3; ++style) {
    const CriticWindows unseen = Dance(99, style);
    const auto right = std::ranges::count_if(unseen.features, [&](const auto& window) {
      return classifier.Classify(window) == static_cast<int>(style);
    });
    EXPECT_GE(right, 25) << "of 30, style " << style;
  }
}

TEST(StyleClassifier, NeedsTwoStyles) {
  ExpectError(ErrorCode::kInvalidArgument, "styles", [] { StyleClassifier(Dances(1), 4); });
}

}  // namespace choreo::style_classifier_test
