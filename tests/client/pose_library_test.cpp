#include "client/cli/pose_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "model/motion/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::cli {

/// What GoogleTest calls the parameter.
void PrintTo(const LibraryPose& pose, std::ostream* out) { *out << pose.id; }

namespace {

const Skeleton& Body() { return Skeleton::Smpl24(); }

class PoseLibraryTest : public testing::TestWithParam<LibraryPose> {};

/// How far a hinge bends the wrong way, in the upper bone's own frame: the lower bone may only
/// point along itself or to `side`.
double WrongWay(const JointPlacement& placed, int upper, int lower, const Eigen::Vector3d& side) {
  const int end = static_cast<int>(std::find(Body().parents.begin(), Body().parents.end(), lower) -
                                   Body().parents.begin());
  const Eigen::Vector3d bone =
      (placed.positions.col(end) - placed.positions.col(lower)).normalized();
  const Eigen::Vector3d rest = Body().offsets.col(end).normalized();
  const Eigen::Vector3d local = placed.rotations[static_cast<size_t>(upper)].transpose() * bone;
  return (rest - local).dot(side);
}

TEST_P(PoseLibraryTest, StandsOnTheFloor) {
  const Eigen::Matrix3Xd joints = JointPositions(Body(), GetParam().pose);
  const Eigen::Matrix3Xd rest = JointPositions(Body(), RestPose(Body()));
  double lowest = 1e9;
  double rest_height = 1e9;
  for (const int foot : Body().feet) {
    lowest = std::min(lowest, joints(1, foot));
    rest_height = std::min(rest_height, rest(1, foot));
  }
  EXPECT_NEAR(lowest, rest_height, 0.03);
  EXPECT_GT(joints.row(1).minCoeff(), 0);
}

TEST_P(PoseLibraryTest, KeepsItsBalance) {
  // The hips stand above the feet, or between them.
  const Eigen::Matrix3Xd joints = JointPositions(Body(), GetParam().pose);
  double nearest = 1e9;
  for (double between = 0; between <= 1; between += 0.05) {
    const Eigen::Vector3d support =
        (1 - between) * joints.col(Body().feet[0]) + between * joints.col(Body().feet[2]);
    const Eigen::Vector3d apart = support - joints.col(0);
    nearest = std::min(nearest, std::hypot(apart.x(), apart.z()));
  }
  EXPECT_LT(nearest, 0.15);
}

TEST_P(PoseLibraryTest, BendsKneesAndElbowsTheRightWay) {
  const JointPlacement placed = ForwardKinematics(Body(), GetParam().pose);
  const Eigen::Vector3d back(0, 0, -1);
  const Eigen::Vector3d front(0, 0, 1);
  EXPECT_LT(WrongWay(placed, Body().left_hip, Body().left_knee, back), 0.05);
  EXPECT_LT(WrongWay(placed, Body().right_hip, Body().right_knee, back), 0.05);
  EXPECT_LT(WrongWay(placed, Body().left_shoulder, Body().left_elbow, front), 0.05);
  EXPECT_LT(WrongWay(placed, Body().right_shoulder, Body().right_elbow, front), 0.05);
}

TEST_P(PoseLibraryTest, TurnsHipsNoFurtherThanADancerCan) {
  // A thigh that is turned inside out would let a knee bend the wrong way unnoticed.
  const JointPlacement placed = ForwardKinematics(Body(), GetParam().pose);
  for (const int hip : {Body().left_hip, Body().right_hip}) {
    const Eigen::Vector3d knee_axis = placed.rotations[static_cast<size_t>(hip)].col(0);
    EXPECT_GT(knee_axis.dot(placed.rotations[0].col(0)), -0.1)
        << Body().joint_names[static_cast<size_t>(hip)];
  }
}

TEST_P(PoseLibraryTest, FacesTheAudienceAtTheOrigin) {
  const Pose& pose = GetParam().pose;
  EXPECT_LT(std::hypot(pose.root_position.x(), pose.root_position.z()), 0.3);
  EXPECT_GT(ForwardKinematics(Body(), pose).rotations[0](2, 2), 0.7);
}

TEST_P(PoseLibraryTest, IsDescribedAndUnlikeTheOthers) {
  EXPECT_FALSE(GetParam().description.empty());
  for (const LibraryPose& other : PoseLibrary()) {
    if (other.id == GetParam().id) continue;
    EXPECT_GT(ComparePoses(Body(), GetParam().pose, other.pose).position_m, 0.2) << other.id;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PoseLibraryTest, testing::ValuesIn(PoseLibrary()),
                         [](const auto& instance) { return instance.param.id; });

TEST(PoseLibrary, HasEnoughForADanceAndFindsThemByName) {
  EXPECT_GE(PoseLibrary().size(), 8U);
  EXPECT_EQ(FindLibraryPose("arabesque").id, "arabesque");
  ExpectError(ErrorCode::kNotFound, "which has arabesque, contrapposto",
              [] { FindLibraryPose("robot"); });
}

}  // namespace
}  // namespace choreo::cli
