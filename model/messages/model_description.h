#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/messages/style_figures.h"
#include "model/motion/skeleton.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// What a server reports about a loaded model.
struct ModelDescription {
  std::string name = {};
  std::string fingerprint = {};  ///< equal fingerprints give equal bits
  std::string licence = {};      ///< terms of the weights
  std::string card = {};         ///< JSON
  Skeleton skeleton = {};
  double fps = kModelFps;
  int history_frames = 0;  ///< past frames that it conditions on
  double default_temperature = 0;
  std::vector<std::string> controls = {};  ///< names of kControls (motion/controls.h)
  std::vector<VelocityReference> velocity_references = {};  ///< the first is the default
  std::vector<std::string> styles = {};                     ///< that a request may name
  std::optional<StyleFigures> style_figures = {};           ///< none: not measured
  bool takes_music = true;                                  ///< false: it refuses audio
  bool likelihood = false;     ///< reports include one, and candidates can be ranked by it
  bool deterministic = false;  ///< seed and temperature have no effect; it rests without a next key
  double audio_lead_s = 0;     ///< music that a transition needs before its first frame
  int latency_frames = 0;  ///< how far the music must be ahead of a frame, in the model's frames
  int max_transition_frames = 0;  ///< per transition; includes the server's own limit
};

}  // namespace choreo
