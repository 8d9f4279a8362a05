#include "model/flow/network/torch_kinematics.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include "model/core/numbers/random.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo::torch_kinematics_test {

Pose RandomPose(const Skeleton& skeleton, Random* random) {
  Pose pose;
  pose.root_position = {random->Normal(), random->Normal(), random->Normal()};
  pose.rotations.resize(3, skeleton.joints());
  for (Eigen::Index i = 0; i < pose.rotations.size(); ++i) {
    pose.rotations.data()[i] = random->Uniform(-1.5, 1.5);
  }
  return pose;
}

TEST(TorchKinematics, AgreesWithDoublePrecision) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const TorchKinematics kinematics(skeleton);
  Random random(3);
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Pose pose = RandomPose(skeleton, &random);
    const torch::Tensor root = torch::tensor(
        {{pose.root_position[0], pose.root_position[1], pose.root_position[2]}}, torch::kFloat64);
    const torch::Tensor w = torch::from_blob(const_cast<double*>(pose.rotations.data()),
                                             {1, skeleton.joints(), 3}, torch::kFloat64);
    const torch::Tensor positions = kinematics.Positions(root, ExpMapBatch(w));
    const Eigen::Matrix3Xd expected = JointPositions(skeleton, pose);
    for (int j = 0; j < skeleton.joints(); ++j) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(positions[0][j][axis].item<double>(), expected(axis, j), 1e-6);
      }
    }
  }
}

TEST(TorchKinematics, LogInvertsExpFromZeroToNearPi) {
  Random random(4);
  for (const double angle : {0.0, 1e-6, 1e-3, 0.5, 2.0, 3.0, 3.1}) {
    Eigen::Vector3d axis(random.Normal(), random.Normal(), random.Normal());
    axis.normalize();
    const Eigen::Vector3d w = angle * axis;
    const torch::Tensor back =
        LogMapBatch(ExpMapBatch(torch::tensor({w[0], w[1], w[2]}, torch::kFloat64)));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i].item<double>(), w[i], 2e-6) << angle;
  }
}

}  // namespace choreo::torch_kinematics_test
