#pragma once

#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What a server tells of a model that it has loaded.
struct ModelDescription {
  std::string name = {};
  std::string fingerprint = {};  ///< equal fingerprints give equal bits
  std::string licence = {};      ///< terms of the weights
  std::string card = {};         ///< JSON
  Skeleton skeleton = {};
  double fps = kModelFps;
  int history_frames = 0;  ///< frames of the past that it looks at
  double default_temperature = 0;
  std::vector<std::string> controls = {};  ///< of the names in kControls (motion/controls.h)
  /// How lively its dancers usually are: what multipliers refer to; the first is the default.
  struct VelocityReference {
    std::string name = {};
    std::vector<double> speeds = {};  ///< metres a frame, in the order of kBodyPartNames
  };
  std::vector<VelocityReference> velocity_references = {};
  std::vector<std::string> styles = {};  ///< that a dance may be asked for in
  bool takes_music = true;               ///< false: it refuses audio
  bool likelihood = false;               ///< reports have one, by which candidates can be ranked
  bool deterministic = false;  ///< seed and temperature change nothing; rests without a key ahead
  double audio_lead_s = 0;     ///< music that a transition wants before its first frame
  int latency_frames = 0;      ///< how far the music must be ahead of the frame that is made
  int max_transition_frames = 0;  ///< of one transition; the server's own limit is in it already
};

}  // namespace choreo
