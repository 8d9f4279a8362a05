#include "model/plan/transition_spec.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::valid_spec_test {

class ValidSpecTest : public testing::Test {
 protected:
  ValidSpecTest() {
    model_.name = "walker";
    model_.skeleton = Skeleton::Smpl24();
    model_.controls = ControlNames();
    spec_.frames = 5;
    spec_.history.assign(static_cast<size_t>(model_.history_frames), RestPose(model_.skeleton));
    spec_.controls[kRootPath].values.setZero(3, 5);
    spec_.controls[kVelocityFactors].values.setConstant(kBodyParts, 5, 0.02F);
  }

  void ExpectRefused(const std::string& part) const {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { ValidSpec(spec_, model_); });
  }

  ModelInfo model_;
  TransitionSpec spec_;
};

TEST_F(ValidSpecTest, TakesBothControlsOrEitherOrNone) {
  EXPECT_NO_THROW(ValidSpec(spec_, model_));
  spec_.controls[kRootPath].values.resize(3, 0);
  EXPECT_NO_THROW(ValidSpec(spec_, model_));
  spec_.controls = {};
  EXPECT_NO_THROW(ValidSpec(spec_, model_));
}

TEST_F(ValidSpecTest, RefusesUnknownControls) {
  std::erase(model_.controls, "root_path");
  ExpectRefused("controls.root_path: the model 'walker' does not take it");
  spec_.controls[kRootPath].values.resize(3, 0);
  model_.controls.clear();
  ExpectRefused("controls.velocity_factors: the model 'walker' does not take it");
}

TEST_F(ValidSpecTest, RefusesControlsOfTheWrongSize) {
  spec_.controls[kRootPath].values.setZero(3, 4);
  ExpectRefused("controls.root_path: 4 frames, must be 5");
  spec_.controls[kRootPath].values.resize(3, 0);
  spec_.controls[kVelocityFactors].values.setZero(kBodyParts, 6);
  ExpectRefused("controls.velocity_factors: 6 frames, must be 5");
}

TEST_F(ValidSpecTest, RefusesControlsThatAreNotFiniteOrNegative) {
  spec_.controls[kVelocityFactors].values(2, 3) = -0.01F;
  ExpectRefused("controls.velocity_factors: -0.01");
  spec_.controls[kRootPath].values(1, 4) = std::numeric_limits<float>::quiet_NaN();
  ExpectRefused("controls.root_path: not finite");
}

TEST_F(ValidSpecTest, RefusesStylesAndTemperaturesThatTheModelLacks) {
  model_.styles = {"calm"};
  spec_.style = "Calm";
  ExpectRefused("style: \"Calm\" is not a style of the model walker; did you mean calm?");
  spec_.style = "calm";
  EXPECT_NO_THROW(ValidSpec(spec_, model_));
  spec_.temperature = 2.5F;
  ExpectRefused("temperature: 2.5 is not in [0, 2]");
  spec_.temperature = std::numeric_limits<float>::quiet_NaN();
  ExpectRefused("temperature: nan is not in [0, 2]");
}

}  // namespace choreo::valid_spec_test
