#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "proto/wire/control_messages.h"
#include "tests/server/fixture.h"

namespace choreo::controls_test {

using testing::HasSubstr;

/// A server whose models are "fake", which takes controls, and "plain", which takes none.
class ControlsServerTest : public ServerTest {
 protected:
  ControlsServerTest() {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    std::vector<Server::Samplers> models(2);
    models[0].push_back(std::make_unique<ControlledSampler>());
    models[1].push_back(std::make_unique<ProbedSampler>("plain", probe));
    Connect(std::make_unique<Server>(config, std::move(models)));
  }

  static v1::StreamDanceRequest Asking(const v1::Controls& controls) {
    v1::StreamDanceRequest request;
    *request.mutable_controls() = controls;
    return request;
  }
  /// Dances 120 frames.
  Answer DanceWith(const v1::Controls& controls, const std::string& model = "") {
    v1::StreamDanceRequest config;
    *config.mutable_config() = Config();
    config.mutable_config()->set_model(model);
    config.mutable_config()->set_frames(120);
    return Dance({config, Asking(controls)});
  }
  /// A transition of 60 frames, to a key where the dancer stands.
  static v1::GenerateTransitionRequest Transition(const v1::Controls& controls) {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(60);
    *request.mutable_controls() = controls;
    return request;
  }
};

v1::Controls Path(const std::vector<int64_t>& frames, const std::vector<float>& points,
                  const std::vector<float>& heights = {}) {
  v1::Controls controls;
  controls.mutable_root_path()->mutable_frames()->Add(frames.begin(), frames.end());
  controls.mutable_root_path()->mutable_points()->Add(points.begin(), points.end());
  controls.mutable_root_path()->mutable_heights()->Add(heights.begin(), heights.end());
  return controls;
}

v1::Controls Factors(const std::vector<float>& factors, const std::vector<v1::BodyPart>& parts = {},
                     const std::vector<int64_t>& frames = {}) {
  v1::Controls controls;
  auto* velocity = controls.mutable_velocity_factors();
  velocity->mutable_factors()->Add(factors.begin(), factors.end());
  for (const v1::BodyPart part : parts) velocity->add_parts(part);
  velocity->mutable_frames()->Add(frames.begin(), frames.end());
  return controls;
}

/// The fake model's record of the factor requested for a part, in a frame.
float Asked(const Answer::Joined& dance, BodyPart part, int frame) {
  const Skeleton& body = Skeleton::Smpl24();
  const int joint = body.Find(kTellingJoints[static_cast<size_t>(part)]);
  return dance.rotations[static_cast<size_t>(3 * (frame * body.joints() + joint))];
}

TEST(ControlRows, AreTheApisControls) {
  ASSERT_EQ(v1::Control_descriptor()->value_count(), 1 + std::ssize(kControls));
  for (int row = 0; row < std::ssize(kControls); ++row) {
    const std::string name(kControls[row].name);
    EXPECT_NE(v1::Controls::descriptor()->FindFieldByName(name), nullptr) << name;
    std::string capitals = "CONTROL_" + name;
    std::ranges::transform(capitals, capitals.begin(),
                           [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(v1::Control_Name(static_cast<v1::Control>(row + 1)), capitals);
  }
}

TEST(ControlRows, SurviveTheWire) {
  ControlRequest asked;
  asked.root_path = {.frames = {0, 9}, .points = {{1, 2}, {3, 4}}, .heights = {0.5, 1}};
  asked.velocity_factors = {.frames = {3},
                            .parts = {"trunk", "right_leg"},
                            .factors = {1, 2},
                            .speeds = {0.25, 0.5},
                            .reference = "calm"};
  const ControlRequest came = wire::FromProto(wire::ToProto(asked), "controls");
  ASSERT_TRUE(came.root_path && came.velocity_factors);
  EXPECT_EQ(came.root_path->frames, asked.root_path->frames);
  EXPECT_EQ(came.root_path->points, asked.root_path->points);
  EXPECT_EQ(came.root_path->heights, asked.root_path->heights);
  EXPECT_EQ(came.velocity_factors->frames, asked.velocity_factors->frames);
  EXPECT_EQ(came.velocity_factors->parts, asked.velocity_factors->parts);
  EXPECT_EQ(came.velocity_factors->factors, asked.velocity_factors->factors);
  EXPECT_EQ(came.velocity_factors->speeds, asked.velocity_factors->speeds);
  EXPECT_EQ(came.velocity_factors->reference, asked.velocity_factors->reference);
}

TEST_F(ControlsServerTest, InfoListsEachModelsControls) {
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
  ASSERT_EQ(info.models_size(), 2);
  EXPECT_THAT(info.models(0).controls(),
              testing::ElementsAre(v1::CONTROL_ROOT_PATH, v1::CONTROL_VELOCITY_FACTORS));
  ASSERT_EQ(info.models(0).velocity_references_size(), 2);
  EXPECT_EQ(info.models(0).velocity_references(0).name(), "median");
  EXPECT_THAT(info.models(0).velocity_references(0).speeds(),
              testing::ElementsAre(0.01F, 0.02F, 0.03F, 0.04F, 0.05F));
  EXPECT_FALSE(info.models(0).takes_no_music());
  EXPECT_FALSE(info.models(0).deterministic());
  EXPECT_EQ(info.models(1).controls_size(), 0);
  EXPECT_EQ(info.models(1).velocity_references_size(), 0);
}

TEST_F(ControlsServerTest, ADanceFollowsAPathAndItsHeights) {
  const Answer answer = DanceWith(Path({0, 60, 119}, {0, 0, 1, 0, 1, 1}, {0.9F, 0.5F, 0.85F}));
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const Answer::Joined dance = answer.Join();
  ASSERT_EQ(dance.count, 120);
  const auto root = [&](size_t frame, size_t axis) {
    return dance.root_positions[3 * frame + axis];
  };
  EXPECT_NEAR(root(60, 0), 1, 1e-4);
  EXPECT_NEAR(root(60, 1), 0.5, 1e-4);
  EXPECT_NEAR(root(60, 2), 0, 1e-4);
  EXPECT_NEAR(root(119, 1), 0.85, 0.03);  // where feet reach the floor
  EXPECT_NEAR(root(119, 2), 1, 1e-4);
}

TEST_F(ControlsServerTest, DanceHasTheRequestedPartVelocities) {
  v1::Controls controls =
      Factors({1, 0, 3, 0.5F}, {v1::BODY_PART_LEFT_ARM, v1::BODY_PART_RIGHT_LEG}, {10, 110});
  Answer answer = DanceWith(controls);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  Answer::Joined dance = answer.Join();
  EXPECT_NEAR(Asked(dance, BodyPart::kLeftArm, 60), 2 * 0.02, 1e-5);
  EXPECT_NEAR(Asked(dance, BodyPart::kRightLeg, 60), 0.25 * 0.05, 1e-5);
  EXPECT_NEAR(Asked(dance, BodyPart::kTrunk, 60), 0.01, 1e-5);
  // Relative to another reference, and absolute.
  controls = Factors({10});
  controls.mutable_velocity_factors()->set_reference("calm");
  answer = DanceWith(controls);
  EXPECT_NEAR(Asked(answer.Join(), BodyPart::kLeftLeg, 60), 10 * 0.004, 1e-5);
  controls.Clear();
  controls.mutable_velocity_factors()->add_speeds(0.123F);
  answer = DanceWith(controls);
  EXPECT_NEAR(Asked(answer.Join(), BodyPart::kRightArm, 60), 0.123, 1e-5);
}

TEST_F(ControlsServerTest, TransitionFollowsControls) {
  v1::GenerateTransitionRequest request = Transition(Path({0, 59}, {0, 0, 1, 1}));
  *request.mutable_controls()->mutable_velocity_factors() =
      Factors({2}, {v1::BODY_PART_TRUNK}).velocity_factors();
  const Answer answer = Generate(request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const Answer::Joined frames = answer.Join();
  EXPECT_NEAR(frames.root_positions[3 * 59], 1, 1e-4);
  EXPECT_NEAR(Asked(frames, BodyPart::kTrunk, 30), 0.02, 1e-5);
}

TEST_F(ControlsServerTest, ControlsChangeAheadOfGenerateUntil) {
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  config.set_frames(180);
  client.Send(config);
  v1::StreamDanceRequest request = Asking(Factors({1}));
  client.Send(request);
  client.SendGenerateUntil(60);
  ASSERT_TRUE(client.ReadFrames(60));  // these are danced; what follows is still open
  client.Send(Asking(Factors({4})));
  client.SendGenerateUntil(120);
  client.Send(Asking(Factors({7})));
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const Answer::Joined dance = answer.Join();
  EXPECT_NEAR(Asked(dance, BodyPart::kLeftArm, 59), 0.02, 1e-5);
  EXPECT_NEAR(Asked(dance, BodyPart::kLeftArm, 60), 0.08, 1e-5);
  EXPECT_NEAR(Asked(dance, BodyPart::kLeftArm, 119), 0.08, 1e-5);
  EXPECT_NEAR(Asked(dance, BodyPart::kLeftArm, 120), 0.14, 1e-5);
}

TEST_F(ControlsServerTest, ContradictionsAreWarningsWithTheAmount) {
  v1::StreamDanceRequest config, key;
  *config.mutable_config() = Config();
  *key.mutable_keyframe() = Key("landing", 90, /*x=*/3, /*z=*/0);
  const Answer answer = Dance({config, Asking(Path({0, 15, 90}, {0, 0, 4, 0, 1, 0})), key});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  std::vector<v1::Event> warnings;
  for (const v1::Event& event : answer.events) {
    // The key's pose is random, and so is the motion before it.
    const v1::WarningCode code = event.warning().code();
    const bool is_random =
        code == v1::WARNING_CODE_KEY_IMPOSSIBLE || code == v1::WARNING_CODE_JOINT_TOO_FAST;
    if (event.has_warning() && !is_random) warnings.push_back(event);
  }
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].warning().code(), v1::WARNING_CODE_KEY_OFF_PATH);
  EXPECT_EQ(warnings[0].frame(), 90);
  EXPECT_THAT(warnings[0].warning().message(), HasSubstr("\"landing\" lies 2 m off the root path"));
  EXPECT_EQ(warnings[1].warning().code(), v1::WARNING_CODE_PATH_TOO_FAST);
  EXPECT_LT(warnings[1].frame(), 30);
  EXPECT_THAT(warnings[1].warning().message(), HasSubstr("m/s; people reach 5"));
  // The key takes precedence.
  ASSERT_EQ(answer.summary->report().keyframes_size(), 1);
  EXPECT_LT(answer.summary->report().keyframes(0).errors().final_error_m(), 1e-3);
}

TEST_F(ControlsServerTest, TransitionUsesTheTargetsId) {
  for (const std::string id : {"", "landing"}) {
    v1::GenerateTransitionRequest request = Transition(Path({0, 59}, {0, 0, 1, 0}));
    *request.mutable_target() = Key("", 0, /*x=*/2, /*z=*/0).pose();
    request.set_target_id(id);
    const Answer answer = Generate(request);
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    const std::string name = id.empty() ? "target" : id;
    ASSERT_GE(answer.events.size(), 1u);
    EXPECT_THAT(answer.events[0].warning().message(), HasSubstr("key \"" + name + "\" lies 1 m"));
    EXPECT_EQ(answer.transition_summary->candidates(0).report().keyframes(0).id(), name);
  }
}

TEST_F(ControlsServerTest, WarnsOfAKeyOffThePath) {
  v1::StreamDanceRequest config, key;
  *config.mutable_config() = Config();
  *key.mutable_keyframe() = Key("plie", 90);
  key.mutable_keyframe()->mutable_pose()->clear_root_position();
  const Answer answer = Dance({config, Asking(Path({0, 119}, {0, 0, 1, 0}, {0.6F, 0.6F})), key});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  ASSERT_GE(answer.events.size(), 1u);
  EXPECT_EQ(answer.events[0].warning().code(), v1::WARNING_CODE_KEY_OFF_HEIGHT);
  EXPECT_EQ(answer.events[0].frame(), 90);
  EXPECT_THAT(answer.events[0].warning().message(), HasSubstr("0.38 m too low for its feet"));
}

TEST_F(ControlsServerTest, BothCallsWarnOfAPathAfterTheEnd) {
  const v1::Controls controls = Path({120, 180}, {0, 0, 1, 1});
  const Answer dance = DanceWith(controls), transition = Generate(Transition(controls));
  for (const Answer* answer : {&dance, &transition}) {
    ASSERT_TRUE(answer->status.ok()) << answer->status.error_message();
    ASSERT_EQ(answer->events.size(), 1u);
    EXPECT_EQ(answer->events[0].warning().code(), v1::WARNING_CODE_PATH_BEHIND_END);
    EXPECT_EQ(answer->events[0].frame(), 120);
  }
}

TEST_F(ControlsServerTest, WarnsOfAPathThatComesTooLate) {
  v1::StreamDanceRequest config, until;
  *config.mutable_config() = Config();
  config.mutable_config()->set_frames(120);
  until.mutable_generate_until()->set_frame(60);
  const Answer answer = Dance({config, until, Asking(Path({0, 59}, {0, 0, 1, 1}))});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  ASSERT_EQ(answer.events.size(), 1u);
  EXPECT_EQ(answer.events[0].warning().code(), v1::WARNING_CODE_CONTROLS_TOO_LATE);
}

TEST_F(ControlsServerTest, ModelWithoutControlsRefusesThemByName) {
  Answer answer = DanceWith(Path({0, 59}, {0, 0, 1, 1}), "plain");
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(answer.status.error_message(),
            "controls[0].root_path: the model \"plain\" does not have this control");
  answer = DanceWith(Factors({1}), "plain");
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(answer.status.error_message(),
            "controls[0].velocity_factors: the model \"plain\" does not have this control");
}

TEST_F(ControlsServerTest, RefusedAfterKeyframesComplete) {
  v1::StreamDanceRequest config, complete;
  *config.mutable_config() = Config();
  config.mutable_config()->set_frames(9000);  // not danced before that comes
  complete.mutable_keyframes_complete();
  const Answer answer = Dance({config, complete, Asking(Factors({1}))});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(answer.status.error_message(), "controls[0]: comes after the keys are complete");
}

struct BadControls {
  const char* name;
  v1::Controls controls;
  const char* message;  ///< after "controls." or "controls[0]."
};

// The name of the test's case.
void PrintTo(const BadControls& bad, std::ostream* out) { *out << bad.name; }

class BadControlsTest : public ControlsServerTest, public testing::WithParamInterface<BadControls> {
 protected:
  static void ExpectRefused(const grpc::Status& status, const std::string& prefix) {
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), testing::StartsWith(prefix + GetParam().message));
    const Details details = DetailsOf(status);
    ASSERT_TRUE(details.bad_request);
    EXPECT_THAT(details.bad_request->field_violations(0).field(), testing::StartsWith("controls"));
    EXPECT_EQ(details.bad_request->field_violations(0).field().find("controls["),
              std::string::npos);
  }
};

TEST_P(BadControlsTest, AreRefusedByBothCalls) {
  ExpectRefused(DanceWith(GetParam().controls).status, "controls[0]");
  ExpectRefused(Generate(Transition(GetParam().controls)).status, "controls");
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int64_t kTenHours = 10 * 3600 * 30;

v1::Controls SpeedsAndFactors() {
  v1::Controls controls = Factors({1});
  controls.mutable_velocity_factors()->add_speeds(0.01F);
  return controls;
}
v1::Controls Speed(float speed) {
  v1::Controls controls;
  controls.mutable_velocity_factors()->add_speeds(speed);
  return controls;
}

v1::Controls ReferenceOfSpeeds(const std::string& name) {
  v1::Controls controls = Speed(0.01F);
  controls.mutable_velocity_factors()->set_reference(name);
  return controls;
}
v1::Controls Reference(const std::string& name) {
  v1::Controls controls = Factors({1});
  controls.mutable_velocity_factors()->set_reference(name);
  return controls;
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadControlsTest,
    testing::Values(
        BadControls{"Empty", {}, ": empty; root_path or velocity_factors must be there"},
        BadControls{"NanPath", Path({0, 9}, {0, 0, 0, kNan}),
                    ".root_path.points[3]: nan m is not within 10000 m of 0"},
        BadControls{"InfinitePath", Path({0, 9}, {0, HUGE_VALF, 0, 0}),
                    ".root_path.points[1]: inf m is not within 10000 m of 0"},
        BadControls{"NanHeight", Path({0, 9}, {0, 0, 0, 1}, {1, kNan}),
                    ".root_path.heights[1]: nan m above the floor is not in [0, 2]"},
        BadControls{"UndergroundHeight", Path({0, 9}, {0, 0, 0, 1}, {-5, 1}),
                    ".root_path.heights[0]: -5 m above the floor is not in [0, 2]"},
        BadControls{"HeightThatNobodyLeaps", Path({0, 9}, {0, 0, 0, 1}, {1, 3}),
                    ".root_path.heights[1]: 3 m above the floor is not in [0, 2]"},
        BadControls{"NoPoint", Path({}, {}),
                    ".root_path.points: 0 points, a path needs at least 2"},
        BadControls{"OnePoint", Path({3}, {0, 0}),
                    ".root_path.points: 1 points, a path needs at least 2"},
        BadControls{"HalfAPoint", Path({0, 9}, {0, 0, 1}),
                    ".root_path.points: 3 numbers, not two for each point"},
        BadControls{"MorePointsThanFrames", Path({0, 9}, {0, 0, 1, 1, 2, 2}),
                    ".root_path.points: 3 points for 2 frames"},
        BadControls{"FewerHeightsThanPoints", Path({0, 9}, {0, 0, 1, 1}, {1}),
                    ".root_path.heights: 1 heights for 2 points"},
        BadControls{"FramesBackwards", Path({9, 0}, {0, 0, 1, 1}),
                    ".root_path.frames[1]: 0 is not after the frame before it, 9"},
        BadControls{"FrameBeforeTheMusic", Path({-1, 9}, {0, 0, 1, 1}),
                    ".root_path.frames[0]: -1 is not in [0, 108000]"},
        BadControls{"TenHours", Path({0, kTenHours}, {0, 0, 1, 1}),
                    ".root_path.frames[1]: 1080000 is not in [0, 108000]"},
        BadControls{"NegativeFactor",
                    Factors({1, -0.5F}, {v1::BODY_PART_TRUNK, v1::BODY_PART_LEFT_ARM}),
                    ".velocity_factors.factors[1]: -0.5 is not in [0, 10]"},
        BadControls{"HugeFactor", Factors({10.5F}),
                    ".velocity_factors.factors[0]: 10.5 is not in [0, 10]"},
        BadControls{"NanFactor", Factors({kNan}),
                    ".velocity_factors.factors[0]: nan is not in [0, 10]"},
        BadControls{"NegativeSpeed", Speed(-0.01F),
                    ".velocity_factors.speeds[0]: -0.01 m a frame is not in [0, 0.5]"},
        BadControls{"HugeSpeed", Speed(3), ".velocity_factors.speeds[0]: 3 m a frame is not in"},
        BadControls{"UnknownPart", Factors({1}, {static_cast<v1::BodyPart>(9)}),
                    ".velocity_factors.parts[0]: 9 is not a BodyPart"},
        BadControls{"NoPart", Factors({1}, {v1::BODY_PART_UNSPECIFIED}),
                    ".velocity_factors.parts[0]: 0 is not a BodyPart"},
        BadControls{"PartTwice", Factors({1, 1}, {v1::BODY_PART_TRUNK, v1::BODY_PART_TRUNK}),
                    ".velocity_factors.parts[1]: trunk is there twice"},
        BadControls{"TooFewFactors", Factors({1, 2, 3}, {}, {0, 5}),
                    ".velocity_factors.factors: 3 values, but rows times columns are 2 times 1"},
        BadControls{"NoFactor", Factors({}), ".velocity_factors.factors: 0 values, but rows times"},
        BadControls{"FactorFramesBackwards", Factors({1, 2, 3}, {}, {0, 5, 5}),
                    ".velocity_factors.frames[2]: 5 is not after the frame before it, 5"},
        BadControls{
            "UnknownReference", Reference("frantic"),
            ".velocity_factors.reference: \"frantic\" is none of the model's, median, calm"},
        BadControls{"ReferenceOfSpeeds", ReferenceOfSpeeds("calm"),
                    ".velocity_factors.reference: \"calm\" cannot be combined with speeds, which "
                    "have none"},
        BadControls{"FactorsAndSpeeds", SpeedsAndFactors(),
                    ".velocity_factors.speeds: and factors exclude each other"}),
    [](const auto& suite) { return std::string(suite.param.name); });

}  // namespace choreo::controls_test
