#pragma once

#include <cstdint>

#include "choreo/v1/choreography.pb.h"
#include "model/dance/dance_stream.h"
#include "model/engine/transition_spec.h"
#include "model/messages/model_description.h"

/// The dance's own types -> messages of the API; what clients read, too, is proto/wire's. Pure
/// functions, thread-safe.
namespace choreo {

/// `audio_format` null: no music.
void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out);
/// What clients are told of a model.
ModelDescription DescribeModel(const ModelInfo& model);

}  // namespace choreo
