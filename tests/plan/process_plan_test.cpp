#include "model/plan/process_plan.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::process_plan_test {

// A dancer who floats, by a model alone: neither arrival nor footwork.
class ProcessPlanTest : public ::testing::Test {
 protected:
  ProcessPlanTest() {
    model_.skeleton = Skeleton::Smpl24();
    spec_.frames = 60;
    spec_.history.assign(10, RestPose(model_.skeleton));
    spec_.arrival_frames = 0;
    spec_.footwork = false;
    plan_.poses.assign(60, RestPose(model_.skeleton));
    for (Pose& pose : plan_.poses) pose.root_position.y() += 0.2;
  }
  Plan Process(bool held = false) {
    const ValidSpec valid(spec_, model_);
    return ProcessPlan(model_, valid, held, plan_).Finish().plan;
  }
  double Fall(const Plan& processed) const {
    return plan_.poses.back().root_position.y() - processed.poses.back().root_position.y();
  }

  ModelInfo model_;
  TransitionSpec spec_;
  Plan plan_;
};

TEST_F(ProcessPlanTest, StagesPassUnlessTheModelOrAHoldLeavesThemOut) {
  EXPECT_EQ(Fall(Process()), 0);
  model_.plan_stages = true;
  EXPECT_NEAR(Fall(Process()), 0.2, 0.01) << "to the floor, with knees a little bent";
  EXPECT_EQ(Fall(Process(/*held=*/true)), 0);
}

// For a model whose plans are put on their feet.
TEST_F(ProcessPlanTest, AnArmInTheTrunkTurns) {
  const int shoulder = model_.skeleton.left_shoulder, elbow = model_.skeleton.left_elbow;
  for (Pose& pose : plan_.poses) {
    pose.rotations.col(shoulder) = Eigen::Vector3d(0, 0, -1.3);  // down the side,
    pose.rotations.col(elbow) = Eigen::Vector3d(0, 0, -1.4);     // and into it
  }
  const auto turned = [&] {
    return (Process().poses[30].rotations.col(shoulder) - plan_.poses[30].rotations.col(shoulder))
        .norm();
  };
  model_.plan_stages = true;
  EXPECT_LT(turned(), 1e-9);
  spec_.footwork = true;
  EXPECT_GT(turned(), 0.05);
  model_.plan_stages = false;
  EXPECT_LT(turned(), 1e-9);
}

TEST_F(ProcessPlanTest, ContactsAreDetectedUnlessTheModelHasItsOwn) {
  constexpr Contacts kDown = {1, 1, 1, 1};
  EXPECT_EQ(Process().contacts, std::vector<Contacts>(60));
  plan_.poses.assign(60, RestPose(model_.skeleton));
  EXPECT_EQ(Process().contacts, std::vector<Contacts>(60, kDown));
  plan_.contacts.assign(60, {0.5F, 0, 0, 0});
  EXPECT_EQ(Process().contacts, plan_.contacts);
}

}  // namespace choreo::process_plan_test
