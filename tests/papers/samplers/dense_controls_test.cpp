#include "model/papers/samplers/dense_controls.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::dense_controls_test {

class DenseControlsTest : public testing::Test {
 protected:
  DenseControlsTest() {
    model_.skeleton = Skeleton::Smpl24();
    model_.controls = ControlNames();
    model_.velocity_references = {{"median", {0.01F, 0.02F, 0.03F, 0.04F, 0.05F}}};
    spec_.frames = 60;
    for (int t = 0; t < model_.history_frames; ++t) {
      Pose pose = RestPose(model_.skeleton);  // walks 2 cm a frame and stands above the origin last
      pose.root_position.z() = 0.02 * (t + 1 - model_.history_frames);
      spec_.history.push_back(pose);
    }
    Pose there = spec_.history.back();
    there.root_position += Eigen::Vector3d(1, 0.1, 1.5);
    spec_.target = Target{there, {}};
  }

  Eigen::Vector3d Start() const { return spec_.history.back().root_position; }

  ModelInfo model_;
  TransitionSpec spec_;
};

TEST_F(DenseControlsTest, LeaveWithTheVelocityOfTheHistoryAndEndAtTheKey) {
  const Controls dense = DenseControls(spec_, model_);
  ASSERT_EQ(dense[kRootPath].values.cols(), 60);
  const Eigen::Vector3d first = dense[kRootPath].values.col(0).cast<double>() - Start();
  EXPECT_NEAR(first.z(), 0.02, 0.002);
  EXPECT_NEAR(first.x(), 0, 0.002);
  EXPECT_LT(
      (dense[kRootPath].values.col(59).cast<double>() - spec_.target->pose.root_position).norm(),
      1e-5);
  for (int part = 0; part < kBodyParts; ++part) {
    EXPECT_FLOAT_EQ(dense[kVelocityFactors].values(part, 30),
                    model_.velocity_references[0].speeds[static_cast<size_t>(part)]);
  }
}

TEST_F(DenseControlsTest, WithoutAKeyTheRootComesToAStop) {
  spec_.target.reset();
  const Controls dense = DenseControls(spec_, model_);
  EXPECT_LT((dense[kRootPath].values.col(59) - dense[kRootPath].values.col(58)).norm(), 1e-4);
  EXPECT_GT(dense[kRootPath].values(2, 59), 0.05);
  EXPECT_NEAR(dense[kRootPath].values(1, 59), Start().y(), 1e-6);
}

TEST_F(DenseControlsTest, UnplacedKeyIsMetAtItsHeight) {
  spec_.target->mask.root_position = false;
  const Controls open = DenseControls(spec_, model_);
  EXPECT_NEAR(open[kRootPath].values(1, 59), Start().y(), 1e-6);
  spec_.target->height = 0.6;
  const Controls dense = DenseControls(spec_, model_);
  EXPECT_NEAR(dense[kRootPath].values(1, 59), 0.6, 1e-6);
  for (const int axis : {0, 2})
    EXPECT_EQ(dense[kRootPath].values.row(axis), open[kRootPath].values.row(axis));
}

// Bent to history and key it comes from dance/controls/path_lead.h.
TEST_F(DenseControlsTest, GivenControlsStay) {
  spec_.controls[kRootPath].values.setRandom(3, 60);
  spec_.controls[kVelocityFactors].values.setConstant(kBodyParts, 60, 0.07F);
  const Controls dense = DenseControls(spec_, model_);
  EXPECT_EQ(dense[kRootPath].values, spec_.controls[kRootPath].values);
  EXPECT_EQ(dense[kVelocityFactors].values, spec_.controls[kVelocityFactors].values);
}

TEST_F(DenseControlsTest, SingleFrameEqualsTheKey) {
  spec_.frames = 1;
  EXPECT_LT((DenseControls(spec_, model_)[kRootPath].values.col(0).cast<double>() -
             spec_.target->pose.root_position)
                .norm(),
            1e-5);
}

}  // namespace choreo::dense_controls_test
