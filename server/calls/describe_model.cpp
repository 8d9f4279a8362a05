#include "server/calls/describe_model.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "model/audio/signal/format.h"
#include "model/dance/dance_stream.h"

namespace choreo {
namespace {

/// The values measured (docs/results.md) for a shipped checkpoint with this training; none for
/// others.
std::optional<StyleFigures> FindStyleFigures(std::string_view weights) {
  constexpr std::pair<std::string_view, StyleFigures> kMeasured[] = {
      {"26bfadad19dc69d0590692f89aafbedb", {7.9, 6.25, 7.1}},     // default: 16 moods
      {"7286cdc80932bef860a65c06cf4d9667", {51, 100.0 / 3, 49}},  // free: 3 genres
  };
  for (const auto& [hash, figures] : kMeasured)
    if (weights == hash) return figures;
  return std::nullopt;
}

}  // namespace

ModelDescription DescribeModel(const ModelInfo& model) {
  ModelDescription out = model;
  out.style_figures = FindStyleFigures(model.weights);
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
