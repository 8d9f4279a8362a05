#include "model/metrics/critic_families.h"

#include <gtest/gtest.h>

#include "model/core/numbers/random.h"
#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::critic_families_test {

using testing_support::Carried;
using testing_support::Wave;

const Skeleton& Body() { return Skeleton::Smpl24(); }

constexpr double kRestFloor = 0.02;  // toes at rest

double AreaOf(std::string_view family, const FamilyWindows& real, const FamilyWindows& danced) {
  const auto at = std::ranges::find(kCriticFamilies, family) - kCriticFamilies.begin();
  return FamilyAreas(real, danced)[static_cast<size_t>(at)];
}

// Ten clips of 20 s: bodies sway, arms swing, feet step by turns; all of it `lift` metres higher.
FamilyWindows Dancers(uint64_t seed, double lift, double arms) {
  FamilyWindows windows;
  Random random(seed);
  for (size_t clip = 0; clip < 10; ++clip) {
    const double hz = random.Uniform(0.5, 1.5), width = random.Uniform(0.02, 0.05);
    JointTrack track = Carried(600, [&](double s) {
      return Eigen::Vector3d(width * Wave(hz, s), lift, 0.5 * width * Wave(0.7 * hz, s));
    });
    for (size_t t = 0; t < track.size(); ++t) {
      const double seconds = static_cast<double>(t) / 30;
      for (const char* wrist : {"left_wrist", "right_wrist"})
        track[t](1, Body().Find(wrist)) += arms * Wave(hz, seconds);
      const int side = Wave(hz, seconds) > 0 ? 0 : 2;
      for (const int joint : {side, side + 1})
        track[t](1, Body().feet[joint]) += 0.1 * std::abs(Wave(hz, seconds));
      for (double& value : track[t].reshaped()) value += 0.001 * random.Normal();
    }
    AddFamilies(Body(), 30, track, kRestFloor, clip, &windows);
  }
  return windows;
}

TEST(CriticFamilies, CutAMotionIntoWindowsOfTwoSeconds) {
  FamilyWindows windows;
  AddFamilies(Body(), 30, Carried(190, [](double) { return Eigen::Vector3d::Zero().eval(); }),
              kRestFloor, 7, &windows);
  for (const CriticWindows& family : windows) {
    EXPECT_EQ(family.clips, (std::vector<size_t>{7, 7, 7}));
    for (const Eigen::VectorXd& features : family.features) EXPECT_TRUE(features.allFinite());
  }
  AddFamilies(Body(), 30, Carried(60, [](double) { return Eigen::Vector3d(0, 2, 0); }), kRestFloor,
              8, &windows);  // nothing is on the floor
  EXPECT_TRUE(windows[1].features.back().allFinite());
  EXPECT_TRUE(windows[2].features.back().allFinite());
}

TEST(CriticFamilies, EachSeesItsOwnAspectAlone) {
  const FamilyWindows real = Dancers(1, 0, 0.2);
  // With ten clips, what eight teach may mislead about two: below a half also means nothing.
  for (const double area : FamilyAreas(real, Dancers(2, 0, 0.2))) EXPECT_LT(area, 0.7);
  const FamilyWindows lifted = Dancers(2, 0.1, 0.2);
  EXPECT_GT(AreaOf("floor", real, lifted), 0.95);
  EXPECT_GT(AreaOf("contacts", real, lifted), 0.95);
  EXPECT_LT(AreaOf("foot spectrum", real, lifted), 0.7);
  EXPECT_LT(AreaOf("dwell", real, lifted), 0.7);
  const FamilyWindows calm = Dancers(2, 0, 0.02);
  EXPECT_GT(AreaOf("dwell", real, calm), 0.9);
  EXPECT_LT(AreaOf("floor", real, calm), 0.7);
}

TEST(CriticFamilies, NeedKnownMasses) {
  Skeleton body = Body();
  body.joint_names[static_cast<size_t>(body.Find("head"))] = "skull";
  FamilyWindows windows;
  ExpectError(ErrorCode::kInvalidArgument, "'smpl24' of 24 joints", [&] {
    AddFamilies(body, 30, Carried(60, [](double) { return Eigen::Vector3d::Zero().eval(); }), 0, 0,
                &windows);
  });
}

}  // namespace choreo::critic_families_test
