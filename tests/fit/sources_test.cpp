#include "model/fit/sources/sources.h"

#include <gtest/gtest.h>

#include <numbers>

#include "model/core/error.h"
#include "model/fit/solver/fit_clip.h"
#include "model/fit/solver/position_fitter.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/fit/fit_fixtures.h"
#include "tests/support/tang2018_markers.h"

namespace choreo::sources_test {

using fixtures::Dance;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

struct TangCase {
  const char* name;
  PositionClip (*markers)(const Motion&);
  SourceMapping (*source)();
  double head;  // degrees
};

class TangSources : public testing::TestWithParam<TangCase> {};

TEST_P(TangSources, FollowTheirMarkers) {
  const Motion dance = Dance(240);
  const FitResult fit =
      FitClip(GetParam().markers(dance), GetParam().source(), Smpl(), {.ground = false});
  EXPECT_LT(fit.mean_error_m, 0.01);
  double joints = 0, head = 0, foot = 0;
  for (size_t frame = 0; frame < dance.frames.size(); ++frame) {
    const JointPlacement ours = ForwardKinematics(Smpl(), fit.motion.frames[frame]);
    const JointPlacement theirs = ForwardKinematics(Smpl(), dance.frames[frame]);
    const double share = 1.0 / static_cast<double>(dance.frames.size());
    joints += (ours.positions - theirs.positions).colwise().norm().mean() * share;
    const auto angle = [&](const char* joint) {
      const int i = Smpl().Find(joint);
      return LogMap(ours.rotations[i].transpose() * theirs.rotations[i]).norm() * 180 /
             std::numbers::pi * share;
    };
    head += angle("head");
    foot += angle("right_ankle");
  }
  EXPECT_LT(joints, 0.03);
  EXPECT_LT(head, GetParam().head);
  EXPECT_LT(foot, 12);
}

INSTANTIATE_TEST_SUITE_P(Layouts, TangSources,
                         // One temple does not determine the head's turn about it.
                         testing::Values(TangCase{"tang2018", Tang2018Markers, Tang2018Source, 15},
                                         TangCase{"tang61", Tang61Markers, Tang61Source, 30}),
                         [](const auto& layout) { return std::string(layout.param.name); });

TEST(Tang2018Source, StaysOnTheFloorWhenTheSourcesHipsMoveInTheBody) {
  // From the middle on the hips are 8 cm higher, as in recordings that were joined.
  Motion standing;
  standing.frames.assign(300, RestPose(Smpl()));
  PositionClip clip = Tang2018Markers(standing);
  for (size_t frame = 150; frame < clip.frames.size(); ++frame) {
    for (const char* hip : {"left_hip", "right_hip"})
      clip.frames[frame](1, IndexOf(clip.joint_names, hip)) += 0.08;
  }
  const FitResult fit = FitClip(clip, Tang2018Source(), Smpl());
  for (const size_t frame : {20, 280}) {
    const Eigen::Matrix3Xd positions = JointPositions(Smpl(), fit.motion.frames[frame]);
    for (const int foot : Smpl().feet) {
      EXPECT_NEAR(positions(1, foot), JointPositions(Smpl(), RestPose(Smpl()))(1, foot), 0.03)
          << frame;
    }
  }
}

TEST(IdentitySource, OmitsHands) {
  const Skeleton& body = Skeleton::Smpl24();
  const Pose rest = RestPose(body);
  Eigen::Matrix3Xd targets = JointPositions(body, rest);
  for (const char* hand : {"left_hand", "right_hand"})
    targets.col(body.Find(hand)) += Eigen::Vector3d(0, -0.05, 0.08);
  const auto bend = [&](double hands) {
    PositionFitter fitter(body, IdentitySource(body, hands));
    fitter.Reset(rest);
    return fitter.Next(targets).rotations.col(body.Find("left_wrist")).norm();
  };
  EXPECT_GT(bend(1), 0.5);
  EXPECT_LT(bend(0), 0.01);
}

TEST(SourceMapping, IsCheckedAgainstOurSkeleton) {
  SourceMapping mapping = IdentitySource(Smpl());
  mapping.landmarks[3].ours[0].joint = "tail";
  EXPECT_THROW(PositionFitter(Smpl(), mapping), Error);
  mapping = IdentitySource(Smpl());
  mapping.landmarks[3].ours[0].weight = 0.9;
  EXPECT_THROW(PositionFitter(Smpl(), mapping), Error);
  mapping = IdentitySource(Smpl());
  mapping.landmarks[3].parent = 3;
  EXPECT_THROW(PositionFitter(Smpl(), mapping), Error);
  EXPECT_THROW(PositionFitter(Smpl(), SourceMapping{}), Error);
}

}  // namespace choreo::sources_test
