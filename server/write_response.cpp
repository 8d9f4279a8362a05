#include "server/write_response.h"

#include <algorithm>

#include "model/audio/format.h"
#include "model/dance/transition.h"

namespace choreo {

void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out) {
  out->set_frame(continuation.frame);
  if (audio_format != nullptr && audio_format->encoding() != v1::AUDIO_ENCODING_FILE)
    out->set_audio_from_sample(continuation.audio_from_sample.value_or(0));
  out->set_fingerprint(continuation.fingerprint);
  out->set_seed(seed);
  for (const Pose& pose : continuation.poses) {
    for (const double value : pose.root_position) {
      out->add_root_positions(static_cast<float>(value));
    }
    for (const double value : pose.rotations.reshaped()) {
      out->add_rotations(static_cast<float>(value));
    }
  }
  out->set_skeleton(model.skeleton.name);
  if (continuation.last_beat) out->set_last_beat(*continuation.last_beat);
  if (continuation.stage) {
    out->add_stage(static_cast<float>(continuation.stage->origin.x()));
    out->add_stage(static_cast<float>(continuation.stage->origin.z()));
    out->set_front(static_cast<float>(continuation.stage->heading));
  }
  for (const KeyReached& key : continuation.reached) {
    v1::ReachedKey* added = out->add_reached();
    added->set_id(key.id);
    added->set_frame(key.frame);
    added->set_raw_error_m(key.raw_error_m);
    added->set_final_error_m(key.final_error_m);
    added->set_final_error_deg(key.final_error_deg);
    added->set_correction_m(key.correction_m);
  }
}

ModelDescription DescribeModel(const ModelInfo& model) {
  ModelDescription out{
      .name = model.name,
      .fingerprint = model.fingerprint,
      .licence = model.licence,
      .card = model.card,
      .skeleton = model.skeleton,
      .fps = model.fps,
      .history_frames = model.history_frames,
      .default_temperature = model.default_temperature,
      .controls = model.controls,
      .velocity_references = model.velocity_references,
      .styles = model.styles,
      .takes_music = TakesMusic(model),
      .likelihood = model.likelihood,
      .deterministic = model.deterministic,
      .max_transition_frames = std::min(model.max_transition_frames, kMaxTransitionFrames)};
  if (!out.takes_music) return out;
  // The lowest rate has the longest filter. Any frame far from the start shows the lead.
  constexpr int64_t kSomeFrame = 3'000;
  out.audio_lead_s =
      static_cast<double>(kSomeFrame) / model.fps -
      static_cast<double>(LatestFirstSample(kSomeFrame, kMinSampleRate, model)) / kMinSampleRate;
  DanceConfig config;
  config.output_fps = model.fps;
  config.audio = DanceConfig::Audio{kMinSampleRate, 1, 0};
  out.latency_frames = DanceStream::LatencyFrames(config, model);
  return out;
}

}  // namespace choreo
