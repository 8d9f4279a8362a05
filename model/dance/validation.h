#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/motion/motion.h"

/// What a dance accepts from outside. Every function throws Error(kInvalidArgument) whose field is
/// the sender's path and whose message gives the value and the limit, as in
/// "keyframes[3].rotations[16]: 7.9 rad exceeds 2π".
namespace choreo {

inline constexpr double kMaxPosition = 10'000;  ///< metres from the origin, each axis
inline constexpr double kMaxRotation =
    6.2832;  ///< radians: 2π, rounded up for senders that compute in floats
inline constexpr double kMaxTemperature = 2.0;
inline constexpr int kMaxCandidates = 32;
inline constexpr double kMaxAudioSeconds = 600;  ///< of one stream, counted from sample 0
inline constexpr double kMinSampleRate = 8'000;
inline constexpr double kMaxSampleRate = 192'000;
inline constexpr int kMaxChannels = 8;
inline constexpr double kMinOutputFps = 1;
inline constexpr double kMaxOutputFps = 120;
/// Samples are meant to lie in [-1, 1]; louder ones pass up to this.
inline constexpr float kMaxSample = 1'000;

/// A pose of this skeleton: joint count, finite, position within kMaxPosition, every angle at most
/// kMaxRotation. Degrees of freedom that the mask leaves free are checked alike. `field` is the
/// path of the pose: "keyframes[3]".
void ValidatePose(const Skeleton& skeleton, const Pose& pose, const std::string& field);

/// A mask for this skeleton that asks for something.
void ValidateMask(const Skeleton& skeleton, const PoseMask& mask, const std::string& field);

/// Poses of a history or continuation. Angles may lie on any branch: they come from a continuous
/// motion.
void ValidateHistory(const Skeleton& skeleton, std::span<const Pose> poses,
                     const std::string& field);

void ValidateTemperature(float temperature, const std::string& field);
void ValidateOutputFps(double fps, const std::string& field);
void ValidateAudioFormat(double sample_rate, int channels, const std::string& field);

/// Whole frames of all channels, finite, at most kMaxSample. `first_sample` makes the path
/// absolute.
void ValidateSamples(std::span<const float> interleaved, int channels, int64_t first_sample,
                     const std::string& field);

/// A number as messages show it: short, without trailing zeros.
std::string Show(double value);

}  // namespace choreo
