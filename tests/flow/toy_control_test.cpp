#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "model/flow/window/window_features.h"
#include "tests/flow/flow_scene.h"
#include "tests/support/expect_error.h"
#include "tests/support/toy_control.h"

// Two more rows in the table of controls, and all that walks it knows them.
namespace choreo::toy_control_test {

constexpr std::array<ControlRow, 4> kRows = {
    kControls[kRootPath],
    kControls[kVelocityFactors],
    toy::kRows[toy::kGaze],
    {"weight", "weight", "--weight", ControlSpace::kPlain, 2, ControlFeatures::kPlain, 0, "kg"}};
constexpr size_t kGaze = 2, kWeight = 3;

WindowRequest Toy() {
  WindowRequest request = MakeScene(30).request;
  request.controls = Controls(kRows);
  request.controls[kGaze].values = Eigen::Vector3d(1, 2, 3).replicate(1, 30);
  request.controls[kWeight].values.setRandom(2, 30).array() += 2;
  return request;
}

TEST(ToyControl, IsValidatedAndNamed) {
  Controls controls = Toy().controls;
  const auto refused = [&](std::vector<std::string> taken, const std::string& message) {
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { controls.Check(taken, "walker", 30); });
  };
  EXPECT_NO_THROW(controls.Check(std::array<std::string, 2>{"gaze", "weight"}, "walker", 30));
  refused({"weight"}, "controls.gaze: the model 'walker' does not take it");
  controls[kWeight].values(1, 4) = -1.5;
  refused({"gaze", "weight"}, "controls.weight: -1.5 kg, must be at least 0");
  controls[kGaze].values.conservativeResize(3, 29);
  refused({"gaze", "weight"}, "controls.gaze: 29 frames, must be 30");
  controls[kGaze].values.setZero(2, 30);
  refused({"gaze", "weight"}, "controls.gaze: 2 numbers a frame, must be 3");
}

// The level of a sixth channel was read beyond the medians of the five body parts.
TEST(ToyControl, HasTheChannelsOfItsSpaceAndFeatures) {
  const auto refused = [](ControlSpace space, int channels, ControlFeatures features,
                          const std::string& message) {
    const ControlRow row{"toy", "toy", "--toy", space, channels, features};
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { Controls({&row, 1}); });
  };
  refused(ControlSpace::kPlain, kBodyParts + 1, ControlFeatures::kLevel,
          "controls.toy: 6 channels, must be 5");
  refused(ControlSpace::kPerPart, 4, ControlFeatures::kPlain,
          "controls.toy: 4 channels, must be 5");
  refused(ControlSpace::kPlace, 2, ControlFeatures::kPlain, "controls.toy: 2 channels, must be 3");
}

TEST(ToyControl, IsCutTurnedAndMirrored) {
  const WindowRequest request = Toy();
  const GroundFrame quarter{.origin = {1, 0, 1}, .heading = std::numbers::pi / 2};
  const WindowRequest part = request.Part(10, 5, request.history, quarter);
  ASSERT_EQ(part.controls[kGaze].values.cols(), 5);
  const Eigen::Vector3d turned = quarter.ToLocal(Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(part.controls[kGaze].values.col(4), turned);
  EXPECT_GT((turned - Eigen::Vector3d(1, 2, 3)).norm(), 1);
  EXPECT_EQ(part.controls[kWeight].values, request.controls[kWeight].values.middleCols(10, 5));
  const WindowRequest mirrored = Mirror(MirrorPairs(Skeleton::Smpl24()), request);
  EXPECT_EQ(mirrored.controls[kGaze].values.col(0), Eigen::Vector3d(-1, 2, 3));
  EXPECT_EQ(mirrored.controls[kWeight].values, request.controls[kWeight].values);
}

TEST(ToyControl, BecomesFeaturesAfterTheOthers) {
  const FlowModelParts parts = Parts();
  WindowRequest request = Toy();
  request.controls[kRootPath].values = Eigen::Matrix3Xd::Ones(3, 30);
  request.controls[kWeight].requested[0] = false;
  WindowRequest without = request;
  without.controls = Controls();
  without.controls[kRootPath] = request.controls[kRootPath];
  const auto describe = [&](const WindowRequest& asked) {
    return DescribeWindow(parts.skeleton, parts.config, parts.prior, asked,
                          FlowWindow(parts.prior, asked))
        .frames;
  };
  const Eigen::MatrixXf with = describe(request), before = describe(without);
  const int own = 6 + 4, begin = 1 + 6 + 5 + 2 * kBodyParts;
  ASSERT_EQ(FrameFeatures(kRows), FrameFeatures() + own);
  EXPECT_EQ(with.topRows(begin), before.topRows(begin));
  EXPECT_EQ(with.bottomRows(FrameFeatures() - begin), before.bottomRows(FrameFeatures() - begin));
  const auto column = with.col(kTau + 7).segment(begin, own);
  const auto heavy = static_cast<float>(request.controls[kWeight].values(1, 7));
  EXPECT_EQ(column, (Eigen::Vector<float, 10>(1, 2, 3, 1, 1, 1, 0, heavy, 0, 1)));
  EXPECT_EQ(with.block(begin, 0, own, kTau).norm(), 0) << "history has none";
}

}  // namespace choreo::toy_control_test
