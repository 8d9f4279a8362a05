#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/dance/transition/transition.h"

namespace choreo {

/// Frames at the output rate. Frame j is the dance at time j / fps.
struct OutputFrames {
  int64_t first_frame = 0;  ///< counted from time 0 at the output rate
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;
};

/// Resamples a dance in progress. An output frame between two model frames waits for the later one
/// and is interpolated: the root linearly, joints along the shortest arcs. At the model's rate
/// frames are unchanged. Not thread-safe.
class OutputRate {
 public:
  /// `first_frame`: the model's first frame. `before`: for a resumed dance, the pose directly
  /// before it; output frames between the two are then included.
  OutputRate(double model_fps, double output_fps, int64_t first_frame, std::optional<Pose> before);

  /// Adds the model's next frame. Returns the output frames, zero or more, that it completes.
  OutputFrames Push(const DanceFrame& frame);

 private:
  double model_fps_;
  double output_fps_;
  int64_t next_input_;
  int64_t next_output_ = 0;
  std::optional<Pose> last_;
};

}  // namespace choreo
