#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "model/core/limits.h"
#include "model/core/text/field.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/messages/continuation.h"
#include "model/motion/motion.h"
#include "model/motion/pose/pose_limits.h"
#include "model/plan/model_info.h"

/// Checks of external input (for audio see audio/signal/format.h). Each function throws
/// Error(kInvalidArgument) whose field is the sender's path and whose message states the value and
/// the limit, as in "keyframes[3].rotations[16]: 7.9 rad exceeds 2π".
namespace choreo {

/// Returns `value`. Throws unless it is in [least, most].
int64_t CheckedIn(int64_t value, int64_t least, int64_t most, const std::string& field);

/// Checks a key's id: 1 to kMaxIdLength bytes.
void CheckKeyId(const std::string& id, const std::string& field);

/// Checks a mask for this skeleton. The mask must not be empty.
void CheckMask(const Skeleton& skeleton, const PoseMask& mask, const std::string& field);

/// Checks a control's frames: strictly ascending, within the longest dance.
void CheckFrames(std::span<const int64_t> frames, const std::string& field);

/// Checks a hit: none, or 0 to kMaxHit.
void CheckHit(std::optional<double> hit, const std::string& field);
/// Checks a continuation: tau poses, a valid frame, and the model's fingerprint. Another
/// fingerprint throws Error(kFailedPrecondition) unless `allow_inexact`; other faults throw
/// Error(kInvalidArgument).
void CheckContinuation(const ModelInfo& model, const Continuation& continuation, bool allow_inexact,
                       const std::string& field);

}  // namespace choreo
