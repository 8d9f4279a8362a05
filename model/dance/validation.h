#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "model/core/field.h"
#include "model/core/limits.h"
#include "model/dance/spec_poses.h"
#include "model/messages/continuation.h"
#include "model/motion/motion.h"
#include "model/motion/pose_limits.h"
#include "model/plan/transition_spec.h"

/// Checks of external input (for audio see audio/format.h). Every function throws
/// Error(kInvalidArgument) whose field is the sender's path and whose message gives the value and
/// the limit, as in "keyframes[3].rotations[16]: 7.9 rad exceeds 2π".
namespace choreo {

/// Returns the value; throws unless it is in [least, most].
int64_t CheckedIn(int64_t value, int64_t least, int64_t most, const std::string& field);

/// Checks a key's id: 1 to kMaxIdLength bytes.
void ValidateKeyId(const std::string& id, const std::string& field);

/// Checks a mask for this skeleton, which must not be empty.
void ValidateMask(const Skeleton& skeleton, const PoseMask& mask, const std::string& field);

/// Checks frames of a control: strictly ascending, within the longest dance.
void ValidateFrames(std::span<const int64_t> frames, const std::string& field);

void ValidateTemperature(double temperature, const std::string& field);
void ValidateShare(double share, const std::string& field);
/// None, or 0 to kMaxHit.
void ValidateHit(std::optional<double> hit, const std::string& field);
void ValidateOutputFps(double fps, const std::string& field);
/// Checks a continuation: tau poses, a frame of a dance, and this model's fingerprint. Another one
/// throws Error(kFailedPrecondition) unless `allow_inexact`; malformed ones throw as above.
void ValidateContinuation(const ModelInfo& model, const Continuation& continuation,
                          bool allow_inexact, const std::string& field);

}  // namespace choreo
