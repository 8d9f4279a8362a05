#pragma once

#include <cstdint>
#include <string>

#include "choreo/v1/choreography.pb.h"
#include "model/messages/continuation.h"
#include "model/motion/skeleton.h"

/// Converts continuations to the API's messages and back, for the server. To clients they are
/// opaque. Pure functions, thread-safe.
namespace choreo::wire {

/// `sends_file`: the client sends a whole file, even when it resumes. The message then names no
/// sample to send music from.
v1::Continuation ToProto(const Continuation& continuation, const Skeleton& skeleton, uint64_t seed,
                         bool sends_file);

/// Reads a continuation, except for the seed. Throws below `field`: Error(kFailedPrecondition) for
/// a dance of another skeleton, Error(kInvalidArgument) for arrays whose sizes do not match
/// `history_frames` poses. The engine validates the values.
Continuation FromProto(const v1::Continuation& message, const Skeleton& skeleton,
                       int history_frames, const std::string& field);

}  // namespace choreo::wire
