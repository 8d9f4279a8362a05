#pragma once

#include <cstdint>

#include "choreo/v1/choreography.pb.h"
#include "model/dance/dance_stream.h"
#include "model/engine/transition_spec.h"

/// The dance's own types -> messages of the API; what clients read, too, is proto/wire's. Pure
/// functions, thread-safe.
namespace choreo {

/// `audio_format` null: no music.
void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out);
void FromModel(const ModelInfo& model, v1::ModelInfo* out);

}  // namespace choreo
