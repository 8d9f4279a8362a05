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
struct GroupRequest : DanceStart {
  int candidates = 1;       ///< 1..32, numbered from 0
  int frames = 0;           ///< 1..min(1800, the model's longest)
  int64_t first_frame = 0;  ///< absolute, model rate; a continuation's frame goes before it
  std::optional<Target> target;
  std::string target_id = "target";  ///< how warnings and the report call it
  std::optional<Pose> after;
  ControlRequest controls;

  /// The music around the transition, from audio->first_sample on, interleaved; beyond its end is
  /// silence.
  std::vector<float> samples;

  /// Number of the first frame to be made.
  int64_t FirstFrame() const { return continuation ? continuation->frame : first_frame; }

  /// Throws Error with paths of the request: "frames", "target.rotations[3]", "history[0]",
  /// "audio.sample_rate", ...
  void Validate(const ModelInfo& model) const;
};

}  // namespace choreo
