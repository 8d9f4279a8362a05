#include "server/write_response.h"

#include <algorithm>

#include "model/audio/format.h"
#include "model/dance/transition.h"
#include "proto/wire/convert.h"

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
    out->add_stage(static_cast<float>(continuation.stage->x()));
    out->add_stage(static_cast<float>(continuation.stage->z()));
  }
}

void FromModel(const ModelInfo& model, v1::ModelInfo* out) {
  out->set_name(model.name);
  out->set_fingerprint(model.fingerprint);
  out->set_licence(model.licence);
  out->set_card(model.card);
  *out->mutable_skeleton() = wire::ToProto(model.skeleton);
  out->set_model_frame_rate(model.fps);
  out->set_history_frames(model.history_frames);
  out->set_default_temperature(model.default_temperature);
  out->set_max_transition_frames(std::min(model.max_transition_frames, kMaxTransitionFrames));
  if (model.root_path) out->add_controls(v1::CONTROL_ROOT_PATH);
  if (model.velocity_factors) out->add_controls(v1::CONTROL_VELOCITY_FACTORS);
  for (const VelocityReference& reference : model.velocity_references) {
    v1::VelocityReference* added = out->add_velocity_references();
    added->set_name(reference.name);
    added->mutable_speeds()->Add(reference.factors.begin(), reference.factors.end());
  }
  out->set_deterministic(model.deterministic);
  out->set_likelihood(model.likelihood);
  out->mutable_styles()->Add(model.styles.begin(), model.styles.end());
  out->set_takes_no_music(!TakesMusic(model));
  if (out->takes_no_music()) return;
  // The lowest rate has the longest filter. Any frame far enough from the start shows the lead.
  constexpr int64_t kSomeFrame = 3'000;
  out->set_audio_lead_s(static_cast<double>(kSomeFrame) / model.fps -
                        static_cast<double>(LatestFirstSample(kSomeFrame, kMinSampleRate, model)) /
                            kMinSampleRate);
  DanceConfig config;
  config.output_fps = model.fps;
  config.audio = DanceConfig::Audio{kMinSampleRate, 1, 0};
  out->set_latency_frames(DanceStream::LatencyFrames(config, model));
}

}  // namespace choreo
