#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "choreo/v1/choreography.pb.h"
#include "model/core/error.h"
#include "model/dance/dance_stream.h"
#include "model/dance/transition_group.h"
#include "model/plan/model_info.h"

/// Checks requests of the API and converts them to the dance's own types. Each function throws
/// Error with the field's path, which begins with `field` if that is a parameter. Pure functions,
/// thread-safe.
namespace choreo {

/// Converts StreamDance's configuration. Uses `fresh_seed` if the message has no seed.
ValidDance ToDanceConfig(const v1::DanceConfig& config, const ModelInfo& model,
                         uint64_t fresh_seed);

/// Converts GenerateTransition's request, except for music files, which are decoded later
/// (server/messages/music_file.h). Uses `fresh_seed` if the message has no seed. `max_candidates`:
/// in [1, kMaxCandidates]; more could never be made at the same time.
ValidGroup ToGroupRequest(const v1::GenerateTransitionRequest& request, const ModelInfo& model,
                          uint64_t fresh_seed, int max_candidates);

/// Reads the samples of a checked format, which is not that of files, interleaved. Errors are in
/// "audio.data".
std::vector<float> ReadSamples(const v1::Audio& audio, const v1::AudioFormat& format);

/// The error for music in `field` without config.audio_format; it shows what to send.
Error WithoutAudioFormat(const std::string& field);

/// Converts controls. Throws if there are none. CheckControls checks the values.
ControlRequest ToControls(const v1::Controls& controls, const std::string& field);

}  // namespace choreo
