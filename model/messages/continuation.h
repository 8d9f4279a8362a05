#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/messages/dance_event.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/motion.h"

namespace choreo {

/// The end of a transition, with all that another server needs to resume the dance.
struct Continuation {
  int64_t frame = 0;        ///< the first frame not yet danced; model rate, absolute
  std::vector<Pose> poses;  ///< tau poses before it, oldest first, world, rounded to floats
  std::string fingerprint;  ///< of the model and build that danced
  /// The first sample that the resumed dance needs; none: unknown.
  std::optional<int64_t> audio_from_sample = {};
  std::optional<double> last_beat = {};  ///< BeatSchedule::last at this frame
  std::optional<GroundFrame> stage =
      {};  ///< the middle of the floor, and the audience; its height is not read
  std::vector<KeyReached> reached = {};  ///< before `frame`, ascending, without accelerations
};

}  // namespace choreo
