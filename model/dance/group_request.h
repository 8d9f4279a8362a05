#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/transition.h"

namespace choreo {

/// GenerateTransition: one transition, several candidates of it, ranked.
struct GroupRequest {
  uint64_t seed = 0;
  int candidates = 1;                ///< 1..32, numbered from 0
  std::optional<float> temperature;  ///< 0..2; none: the model's default
  std::string style;                 ///< one of the model's, or empty: any
  double output_fps = 30;
  int frames = 0;             ///< 1..min(1800, the model's longest)
  std::vector<Pose> history;  ///< as TransitionRequest's, but none is the neutral stance where the
                              ///< root path begins; excludes `continuation`
  std::optional<Continuation> continuation;
  bool allow_inexact_resume = false;
  int64_t first_frame = 0;  ///< absolute, model rate; a continuation's frame goes before it
  std::optional<WorldTarget> target;
  std::string target_id = "target";  ///< how warnings and the report call it
  std::optional<Pose> after;
  ControlRequest controls;

  /// The music around the transition, whole: samples from `first_sample` (absolute) on. It must
  /// begin no later than LatestFirstSample; beyond its end is silence. Empty samples
  /// with a rate of 0: no music.
  double sample_rate = 0;
  int channels = 0;
  int64_t first_sample = 0;
  std::vector<float> samples;
  std::vector<double> music_beats;  ///< seconds, ascending: the dance is timed to them

  bool has_audio() const { return sample_rate != 0; }
  /// Number of the first frame to be made, and the poses before it, wherever they are told.
  int64_t FirstFrame() const { return continuation ? continuation->frame : first_frame; }
  const std::vector<Pose>& History() const { return continuation ? continuation->poses : history; }

  /// Throws Error with paths of the request: "frames", "target.rotations[3]", "history[0]",
  /// "audio.sample_rate", ...
  void Validate(const ModelInfo& model) const;
};

}  // namespace choreo
