#include "model/dance/timeline/validation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "tests/dance/dances.h"
#include "tests/dance/poses.h"

namespace choreo::validation_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string Refusal(const std::function<void()>& call,
                    ErrorCode code = ErrorCode::kInvalidArgument) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "accepted";
}

TEST(Validation, PosesNameFieldValueAndLimit) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const auto refusal = [&skeleton](const std::function<void(Pose&)>& spoil) {
    Pose pose = RestPose(skeleton);
    spoil(pose);
    return Refusal([&] { CheckKeyPose(skeleton, pose, "keyframes[3]"); });
  };
  EXPECT_EQ(refusal([](Pose&) {}), "accepted");
  EXPECT_EQ(refusal([](Pose& p) { p.rotations(1, 16) = 7.9; }),
            "keyframes[3].rotations[16]: 7.9 rad exceeds 2π");
  EXPECT_EQ(refusal([](Pose& p) { p.rotations(0, 2) = 6.28318531; }), "accepted");
  EXPECT_EQ(refusal([](Pose& p) { p.rotations(2, 0) = kNan; }),
            "keyframes[3].rotations[0]: nan is not finite");
  EXPECT_EQ(refusal([](Pose& p) { p.rotations(2, 0) = -kInfinity; }),
            "keyframes[3].rotations[0]: inf is not finite");
  EXPECT_EQ(refusal([](Pose& p) { p.root_position.y() = kInfinity; }),
            "keyframes[3].root_position[1]: inf is not finite");
  EXPECT_EQ(refusal([](Pose& p) { p.root_position.z() = -10'001; }),
            "keyframes[3].root_position[2]: -10001 m is further than 10000 m from the origin");
  for (int joints : {0, 23, 25}) {
    EXPECT_EQ(refusal([joints](Pose& p) { p.rotations = Eigen::Matrix3Xd::Zero(3, joints); }),
              "keyframes[3].rotations: " + std::to_string(joints) + " joints, the model has 24");
  }
}

TEST(Validation, MasksFitTheSkeletonAndAreNotEmpty) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const auto refusal = [&skeleton](const PoseMask& mask) {
    return Refusal([&] { CheckMask(skeleton, mask, "target.mask"); });
  };
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_EQ(refusal({false, {}}), "accepted");
  EXPECT_EQ(refusal({true, std::vector<bool>(24, false)}), "accepted");
  EXPECT_EQ(refusal({false, std::vector<bool>(24, false)}), "target.mask: requests nothing");
  EXPECT_EQ(refusal({true, std::vector<bool>(23, true)}),
            "target.mask.joints: 23 joints, the model has 24");
}

TEST(Validation, ConfigsNameFieldValueAndLimit) {
  const FakeSampler sampler;
  const auto refusal = [&sampler](const std::function<void(DanceConfig&)>& spoil,
                                  ErrorCode code = ErrorCode::kInvalidArgument) {
    DanceConfig config;
    spoil(config);
    return Refusal([&] { ValidDance(config, sampler.model()); }, code);
  };
  const Pose rest = RestPose(Skeleton::Smpl24());
  const Continuation good{60, std::vector<Pose>(10, rest), "fake-1"};
  EXPECT_EQ(refusal([](DanceConfig&) {}), "accepted");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.temperature = -0.1; }),
            "temperature: -0.1 is not in [0, 2]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.temperature = std::nanf(""); }),
            "temperature: nan is not in [0, 2]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.music_dynamics = 1.5; }),
            "music_dynamics: 1.5 is not in [0, 1]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.music_dynamics = std::nan(""); }),
            "music_dynamics: nan is not in [0, 1]");
  const std::vector<double> beats = {0.5, 1};
  EXPECT_EQ(refusal([&](DanceConfig& c) { c.music_beats = c.music_downbeats = beats; }),
            "accepted");
  EXPECT_EQ(refusal([](DanceConfig& c) {
              c.music_beats = {1, 1};
            }),
            "music_beats[1]: 1 s is not after the beat before it, 1 s");
  EXPECT_EQ(refusal([](DanceConfig& c) {
              c.music_energies = {0, std::nanf("")};
            }),
            "music_energies[1]: nan is not in [-2, 2]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.music_energies.resize(1201); }),
            "music_energies: 1201 energies, the limit is 1200");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.music_beats = {std::nan("")}; }),
            "music_beats[0]: nan s is not within 0 to 600");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.music_beats = {600.5}; }),
            "music_beats[0]: 600.5 s is not within 0 to 600");
  EXPECT_THAT(refusal([](DanceConfig& c) { c.music_beats.resize(kMaxBeats + 1); }),
              ::testing::HasSubstr("12001 beats, the limit is 12000"));
  EXPECT_EQ(refusal([&](DanceConfig& c) { c.music_beats = beats, c.music_downbeats = {0.75}; }),
            "music_downbeats[0]: 0.75 s is not one of the beats");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.style = "calm"; }), "accepted");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.style = "Calm"; }),
            "style: \"Calm\" is not a style of the model fake; did you mean calm?");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.output_fps = 0; }), "output_fps: 0 is not in [1, 120]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.output_fps = 121; }),
            "output_fps: 121 is not in [1, 120]");
  EXPECT_EQ(refusal([&](DanceConfig& c) { c.history.assign(11, rest); }), "accepted");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.history.assign(2, rest);
              c.history[1].rotations = Eigen::Matrix3Xd::Zero(3, 23);
            }),
            "history[1].rotations: 23 joints, the model has 24");
  EXPECT_EQ(refusal([&](DanceConfig& c) { c.continuation = good; }), "accepted");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.history.assign(1, rest);
            }),
            "before: a history and a continuation exclude each other");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.continuation->poses.pop_back();
            }),
            "continuation.poses: 9 poses, the model needs 10");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.continuation->frame = -1;
            }),
            "continuation.frame: -1 is not in [0, 108001]");
  EXPECT_EQ(refusal([](DanceConfig& c) { c.end_frame = 0; }), "end_frame: 0 is not in [1, 108000]");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.end_frame = 59;
            }),
            "end_frame: 59 is not in [60, 108000]");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.continuation->frame = kMaxDanceFrames + 1;
              c.end_frame = 150;
            }),
            "continuation.frame: 108001 is not in [0, 108000]");
  EXPECT_EQ(refusal([&](DanceConfig& c) {
              c.continuation = good;
              c.continuation->audio_from_sample = -5;
            }),
            "continuation.audio_from_sample: -5 is before the first sample, 0");
  EXPECT_NE(refusal([](DanceConfig& c) { c.audio = DanceConfig::Audio{4000, 1, 0}; }), "accepted");
  EXPECT_NE(refusal([](DanceConfig& c) { c.audio = DanceConfig::Audio{44100, 9, 0}; }), "accepted");
  EXPECT_NE(refusal(
                [](DanceConfig& c) {
                  c.audio = DanceConfig::Audio{44100, 2, 1};
                },
                ErrorCode::kOutOfRange),
            "accepted");
}

// A dance may end with frame 108000, and so may its continuation; no transition goes on from there.
TEST(Validation, TransitionsNameTheFieldTheirFirstFrameCameFrom) {
  const FakeSampler sampler;
  GroupRequest request;
  request.frames = 10;
  request.first_frame = kMaxDanceFrames + 1;
  const auto refusal = [&] { return Refusal([&] { ValidGroup(request, sampler.model()); }); };
  EXPECT_EQ(refusal(), "first_frame: 108001 is not in [0, 108000]");
  request.continuation = Continuation{
      kMaxDanceFrames + 1, std::vector<Pose>(10, RestPose(Skeleton::Smpl24())), "fake-1"};
  EXPECT_EQ(refusal(), "continuation.frame: 108001 is not in [0, 108000]");
}

}  // namespace choreo::validation_test
