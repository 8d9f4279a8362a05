#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "client/choreo_client.h"
#include "client/edit.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/test_server.h"
#include "tests/support/expect_error.h"

namespace choreo::client::controls_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Makes its server die after this many frames.
class DyingSampler final : public ControlledSampler {
 public:
  explicit DyingSampler(int frames) : left_(frames) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override {
    if (--left_ == 0) throw Error(ErrorCode::kUnavailable, "", "the device is gone");
  }

 private:
  int left_;
};

ControlRequest PathControls() {
  ControlRequest controls;
  controls.root_path = {
      .frames = {0, 100, 250}, .points = {{0, 0}, {1, 0.5}, {0, 1}}, .heights = {0.9, 0.7, 0.95}};
  controls.velocity_factors = {.parts = {"left_arm", "trunk"}, .factors = {2, 0.5}};
  return controls;
}

double Asked(const Pose& pose, BodyPart part) {
  return pose.rotations(0, Body().Find(kTellingJoints[static_cast<size_t>(part)]));
}

TEST(ControlsTest, OfTheConfigApplyFromTheFirstFrame) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const Client client({.addresses = {server.address()}});
  const DanceResult dance = client.Dance({.frames = 250, .controls = PathControls()}, {}, {});
  ASSERT_EQ(dance.motion.frames.size(), 250U);
  const Pose& pose = dance.motion.frames[100];
  EXPECT_LT((pose.root_position - Eigen::Vector3d(1, 0.7, 0.5)).norm(), 1e-4);
  EXPECT_NEAR(Asked(pose, BodyPart::kLeftArm), 0.04, 1e-6);
  EXPECT_NEAR(Asked(pose, BodyPart::kTrunk), 0.005, 1e-6);
  EXPECT_NEAR(Asked(pose, BodyPart::kRightLeg), 0.05, 1e-6);
  // This engine's dancers only record the requested factors.
  ASSERT_EQ(dance.warnings.size(), 1U);
  EXPECT_THAT(dance.warnings[0].message, testing::ContainsRegex("left_arm 0[.0-9]* instead of 4"));
  ASSERT_EQ(dance.report.part_speeds.size(), static_cast<size_t>(kBodyParts));
  EXPECT_NEAR(dance.report.part_speeds[1].asked, 0.04, 1e-6);
}

TEST(ControlsTest, BothCallsTakeAStyle) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const Client client({.addresses = {server.address()}});
  EXPECT_EQ(client.GetServerInfo().models.at(0).styles, (std::vector<std::string>{"calm", "wild"}));
  const auto danced = [&](const std::string& style) {
    return client.Dance({.seed = 1, .manner = {.style = style}, .frames = 20}, {}, {})
        .motion.frames.back();
  };
  const auto transition = [&](const std::string& style) {
    return client
        .GenerateTransition({.config = {.seed = 1, .manner = {.style = style}}, .frames = 20})
        .candidates.at(0)
        .motion.frames.back();
  };
  EXPECT_EQ(danced("").rotations, danced("calm").rotations);
  EXPECT_NE(danced("").rotations, danced("wild").rotations);
  EXPECT_NE(transition("").rotations, transition("wild").rotations);
  ExpectError(ErrorCode::kInvalidArgument, "config.style", [&] { danced("foxtrot"); });
}

TEST(ControlsTest, ChangeDuringTheDance) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const Client client({.addresses = {server.address()}});
  const auto dance = client.StartDance({.frames = 120, .controls = PathControls()});
  dance->GenerateUntil(60);
  ControlRequest still;
  still.velocity_factors = {.speeds = {0}};
  dance->SendControls(still);
  dance->CompleteKeys();
  std::vector<Pose> poses;
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* block = std::get_if<FrameBlock>(&*message))
      poses.insert(poses.end(), block->poses.begin(), block->poses.end());
  }
  ASSERT_EQ(poses.size(), 120U);
  EXPECT_NEAR(Asked(poses[59], BodyPart::kLeftArm), 0.04, 1e-6);
  EXPECT_NEAR(Asked(poses[60], BodyPart::kLeftArm), 0, 1e-6);
}

TEST(ControlsTest, SurviveTheLossOfAServer) {
  const TestServer whole(std::make_unique<ControlledSampler>());
  const TestServer second(std::make_unique<ControlledSampler>());
  const TestServer first(std::make_unique<DyingSampler>(150));
  const auto perform = [](const Client& client) {
    DanceResult result;
    const auto dance = client.StartDance({.seed = 5, .frames = 250, .controls = PathControls()});
    dance->GenerateUntil(70);
    ControlRequest lively;
    lively.velocity_factors = {.frames = {100, 200}, .parts = {"right_leg"}, .factors = {1, 3}};
    dance->SendControls(lively);
    KeyPose key{.id = "beside", .frame = 170, .pose = RestPose(Body())};
    dance->SendKey(key);
    dance->CompleteKeys();
    while (const std::optional<Message> message = dance->Next()) {
      if (const auto* block = std::get_if<FrameBlock>(&*message)) {
        result.motion.frames.insert(result.motion.frames.end(), block->poses.begin(),
                                    block->poses.end());
      }
      // The speeds of parts are measured from the resume on.
      const auto* warning = std::get_if<Warning>(&*message);
      if (warning != nullptr && !warning->message.starts_with("parts do not move"))
        result.warnings.push_back(*warning);
      if (std::holds_alternative<Resumed>(*message)) ++result.resumes;
    }
    return result;
  };
  const DanceResult undisturbed = perform(Client({.addresses = {whole.address()}}));
  const DanceResult resumed =
      perform(Client({.addresses = {first.address(), second.address()}, .first_backoff_s = 0.01}));
  EXPECT_EQ(undisturbed.resumes, 0);
  EXPECT_EQ(resumed.resumes, 1);
  ASSERT_EQ(resumed.motion.frames.size(), undisturbed.motion.frames.size());
  for (size_t i = 0; i < resumed.motion.frames.size(); ++i) {
    ASSERT_EQ(resumed.motion.frames[i].root_position, undisturbed.motion.frames[i].root_position);
    ASSERT_EQ(resumed.motion.frames[i].rotations, undisturbed.motion.frames[i].rotations) << i;
  }
  // The key lies off the path, which is said once.
  ASSERT_EQ(undisturbed.warnings.size(), 1U);
  ASSERT_EQ(resumed.warnings.size(), 1U);
  EXPECT_EQ(resumed.warnings[0].message, undisturbed.warnings[0].message);
}

TEST(ControlsTest, OfATransitionAndOfAnEdit) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const Client client({.addresses = {server.address()}});
  TransitionRequest request;
  request.config.controls = PathControls();
  request.frames = 101;
  const TransitionResult result = client.GenerateTransition(request);
  ASSERT_EQ(result.candidates.size(), 1U);
  EXPECT_LT(
      (result.candidates[0].motion.frames[100].root_position - Eigen::Vector3d(1, 0.7, 0.5)).norm(),
      1e-4);

  // Only an edit with controls gives its new frames controls.
  const FinishedDance dance{result.candidates[0].motion, result.candidates[0].contacts};
  EditOptions options;
  options.model = client.GetServerInfo().models[0];
  KeyEdit edit{
      .key = {.id = "key", .frame = 50, .pose = dance.motion.frames[50]}, .from = 20, .to = 80};
  EXPECT_NEAR(
      Asked(SetKey(client, dance, options, edit).dance.motion.frames[30], BodyPart::kLeftArm), 0.04,
      0.02);
  options.controls.velocity_factors = {.parts = {"left_arm"}, .factors = {10}};
  const EditedDance edited = SetKey(client, dance, options, edit);
  EXPECT_NEAR(Asked(edited.dance.motion.frames[30], BodyPart::kLeftArm), 0.2, 1e-6);
  EXPECT_EQ(edited.dance.motion.frames[20].rotations, dance.motion.frames[20].rotations);
  EXPECT_EQ(edited.dance.motion.frames[80].rotations, dance.motion.frames[80].rotations);
}

TEST(ControlsTest, AreDescribedByTheServer) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const auto model = Client({.addresses = {server.address()}}).GetServerInfo().models.at(0);
  EXPECT_THAT(model.controls, testing::ElementsAre("root_path", "velocity_factors"));
  ASSERT_EQ(model.velocity_references.size(), 2U);
  EXPECT_EQ(model.velocity_references[1].name, "calm");
  EXPECT_NEAR(model.velocity_references[1].speeds.at(4), 0.005, 1e-9);
  EXPECT_TRUE(model.takes_music);
}

TEST(ControlsTest, OfAnUnknownPartAreRefusedBeforeSending) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const Client client({.addresses = {server.address()}});
  ControlRequest controls;
  controls.velocity_factors = {.parts = {"tail"}, .factors = {1}};
  ExpectError(ErrorCode::kInvalidArgument,
              "velocity_factors.parts: \"tail\" is none of trunk, left_arm, right_arm, left_leg, "
              "right_leg",
              [&] { client.Dance({.frames = 60, .controls = controls}, {}, {}); });
}

}  // namespace choreo::client::controls_test
