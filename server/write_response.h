#pragma once

#include <cstdint>
#include <span>

#include "choreo/v1/choreography.pb.h"
#include "choreo/v1/motion.pb.h"
#include "model/dance/dance_stream.h"
#include "model/engine/transition_spec.h"

/// The dance's own types -> messages of the API. Pure functions, thread-safe.
namespace choreo {

void FromSkeleton(const Skeleton& skeleton, v1::Skeleton* out);
void FromFrames(int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts> contacts, v1::RotationEncoding encoding, v1::Frames* out);
/// `audio_format` null: no music.
void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out);
void FromReport(const QualityReport& report, v1::QualityReport* out);
void FromEvent(const DanceEvent& event, double fps, v1::Event* out);
void FromModel(const ModelInfo& model, v1::ModelInfo* out);

}  // namespace choreo
