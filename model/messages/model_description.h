#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/messages/style_figures.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What a server reports about a loaded model. The engine's ModelInfo is this, and more.
struct ModelDescription {
  std::string name = {};         ///< "default", "paper-f", ...
  std::string fingerprint = {};  ///< weights + build + kernel set: equal ones give equal bits
  std::string licence = {};      ///< terms of the weights
  std::string card = {};         ///< the model card, JSON
  Skeleton skeleton = {};
  double fps = kModelFps;               ///< rate at which the model runs
  int history_frames = kHistoryFrames;  ///< tau: past frames that it conditions on
  double default_temperature = 0.3;
  std::vector<std::string> controls = {};  ///< supported controls, by their names in kControls
  /// The velocity references; at least one if the model takes velocity factors. The first,
  /// "median", is the default.
  std::vector<VelocityReference> velocity_references = {};
  std::vector<std::string> styles = {};            ///< that a request may name
  std::optional<StyleFigures> style_figures = {};  ///< none: not measured
  bool takes_music = true;                         ///< false: it refuses audio
  bool likelihood = false;     ///< reports include one, and candidates can be ranked by it
  bool deterministic = false;  ///< seed and temperature have no effect; it rests without a next key
  /// The music that a transition needs before its first frame. Only a server fills in this and the
  /// next member.
  double audio_lead_s = 0;
  int latency_frames = 0;  ///< how far the music must be ahead of a frame, in the model's frames
  /// Per transition. A server's report includes its own limit.
  int max_transition_frames = kMaxTransitionFrames;
};

}  // namespace choreo
