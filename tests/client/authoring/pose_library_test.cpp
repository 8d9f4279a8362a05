#include "client/authoring/keys/pose_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "client/authoring/keys/pose_source.h"
#include "model/body/doll.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/joint_angles.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/pose_faults.h"
#include "tests/support/expect_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace choreo::authoring {

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

bool Has(const LibraryPose& pose, const std::string& tag) {
  return std::ranges::find(pose.tags, tag) != pose.tags.end();
}

TEST_P(PoseLibraryTest, TouchesTheFloorUnlessItJumps) {
  const double height = DollAboveFloor(Body(), GetParam().pose);
  if (Has(GetParam(), "jump")) {
    EXPECT_GT(height, 0.1);
    // As high as people jump, however high the feet are.
    const double rise = GetParam().pose.root_position.y() - RestPose(Body()).root_position.y();
    EXPECT_GT(rise, 0.2);
    EXPECT_LT(rise, 0.35);
  } else {
    EXPECT_NEAR(height, 0, 0.03);
  }
  EXPECT_THAT(PoseFaults(Body(), GetParam().pose), testing::IsEmpty());
}

/// Where the mass is: segments of a body as anatomists weigh them (Dempster 1955), as shares.
Eigen::Vector3d CentreOfMass(const Eigen::Matrix3Xd& joints) {
  struct Segment {
    const char *from, *to;
    double share;
  };
  static constexpr Segment kSegments[] = {{"pelvis", "neck", 0.497},
                                          {"neck", "head", 0.081},
                                          {"left_hip", "left_knee", 0.1},
                                          {"right_hip", "right_knee", 0.1},
                                          {"left_knee", "left_ankle", 0.047},
                                          {"right_knee", "right_ankle", 0.047},
                                          {"left_ankle", "left_foot", 0.014},
                                          {"right_ankle", "right_foot", 0.014},
                                          {"left_shoulder", "left_elbow", 0.028},
                                          {"right_shoulder", "right_elbow", 0.028},
                                          {"left_elbow", "left_hand", 0.022},
                                          {"right_elbow", "right_hand", 0.022}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [from, to, share] : kSegments)
    sum += share / 2 * (joints.col(Body().Find(from)) + joints.col(Body().Find(to)));
  return sum;
}

TEST_P(PoseLibraryTest, KeepsItsBalance) {
  // A step or a jump need not.
  if (Has(GetParam(), "travelling") || Has(GetParam(), "jump")) return;
  const Eigen::Matrix3Xd joints = JointPositions(Body(), GetParam().pose);
  const Eigen::RowVectorXd clearance = FloorClearance(Body());
  std::vector<Eigen::Vector2d> support;
  for (int joint = 0; joint < Body().joints(); ++joint) {
    if (joints(1, joint) < clearance[joint] + 0.08)
      support.emplace_back(joints(0, joint), joints(2, joint));
  }
  const Eigen::Vector3d mass = CentreOfMass(joints);
  double nearest = 1e9;  // to what lies between three points of support
  for (const Eigen::Vector2d& a : support) {
    for (const Eigen::Vector2d& b : support) {
      for (const Eigen::Vector2d& c : support) {
        for (int share = 0; share < 36; ++share) {
          const double v = share % 6 / 5.0, w = (1 - v) * (share / 6) / 5.0;
          const Eigen::Vector2d between = (1 - v - w) * a + v * b + w * c;
          nearest = std::min(nearest, (between - Eigen::Vector2d(mass.x(), mass.z())).norm());
        }
      }
    }
  }
  EXPECT_LT(nearest, 0.15);
}

TEST_P(PoseLibraryTest, TurnsNoJointFurtherThanItCan) {
  for (int joint = 0; joint < Body().joints(); ++joint) {
    const auto [low, high] = RangeOf(Body(), joint);
    for (const double degrees :
         DegreesFromRotation(Body(), joint, GetParam().pose.rotations.col(joint))) {
      EXPECT_GE(degrees, low - 2) << Body().joint_names[static_cast<size_t>(joint)];
      EXPECT_LE(degrees, high) << Body().joint_names[static_cast<size_t>(joint)];
    }
  }
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
  // The dancer's left is on our right, in every pose.
  EXPECT_GT(ForwardKinematics(Body(), pose).rotations[0](0, 0), 0.7);
}

TEST_P(PoseLibraryTest, IsDescribedAndUnlikeTheOthers) {
  EXPECT_FALSE(GetParam().description.empty());
  const std::vector<std::string>& tags = GetParam().tags;
  EXPECT_THAT(std::vector(PoseTags().begin(), PoseTags().begin() + 4),
              testing::Contains(tags.front()));
  EXPECT_EQ(tags.size(), IsEnding(GetParam()) ? 2U : 1U);
  for (const LibraryPose& other : PoseLibrary()) {
    if (other.id == GetParam().id) continue;
    EXPECT_GT(ComparePoses(Body(), GetParam().pose, other.pose).position_m, 0.2) << other.id;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PoseLibraryTest, testing::ValuesIn(PoseLibrary()),
                         [](const auto& instance) { return instance.param.id; });

TEST(PoseLibrary, HasEnoughForADanceAndFindsThemByName) {
  EXPECT_GE(PoseLibrary().size(), 40U);
  for (const std::string tag : {"standing", "travelling", "jump", "floor"}) {
    EXPECT_GE(std::ranges::count_if(PoseLibrary(),
                                    [&](const LibraryPose& pose) { return Has(pose, tag); }),
              6)
        << tag;
  }
  for (const LibraryPose& pose : PosesToDance(Body()))
    EXPECT_TRUE(Has(pose, "standing") || Has(pose, "travelling")) << pose.id;
  EXPECT_EQ(FindLibraryPose("arabesque").id, "arabesque");
  ExpectError(ErrorCode::kNotFound, "it has air_guitar, all_fours, arabesque",
              [] { FindLibraryPose("waltz"); });
}

// After a change of a recipe, the poses must be made again.
TEST(PoseLibrary, AgreesWithItsRecipes) {
  const TemporaryFolder folder;
  const Outcome outcome =
      Shell("CHOREO='" CHOREO_PROGRAM "' '" SOURCE_FOLDER "/scripts/make_poses.sh' '" +
            folder.path().string() + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  size_t made = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const LibraryPose& ours = FindLibraryPose(entry.path().stem().string());
    const Pose again = ReadPose(entry.path().string(), Body()).key.pose;
    EXPECT_LT(ComparePoses(Body(), ours.pose, again).position_m, 0.002) << ours.id;
    ++made;
  }
  EXPECT_GE(made, 30U);
}

}  // namespace
}  // namespace choreo::authoring
