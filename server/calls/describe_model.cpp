#include "server/calls/describe_model.h"

#include <algorithm>

#include "model/audio/signal/format.h"
#include "model/dance/dance_stream.h"

namespace choreo {

ModelDescription DescribeModel(const ModelInfo& model) {
  ModelDescription out = model;
  out.max_transition_frames = std::min(model.max_transition_frames, kMaxTransitionFrames);
  if (!out.takes_music) return out;
  // The lowest rate has the longest filter. Any frame far from the start shows the lead.
  constexpr int64_t kSomeFrame = 3'000;
  out.audio_lead_s =
      static_cast<double>(kSomeFrame) / model.fps -
      static_cast<double>(LatestFirstSample(kSomeFrame, kMinSampleRate, model)) / kMinSampleRate;
  DanceConfig config;
  config.output_fps = model.fps;
  config.audio = DanceConfig::Audio{kMinSampleRate, 1, 0};
  out.latency_frames = LatencyFrames(config, model);
  return out;
}

}  // namespace choreo
