#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/dance/transition.h"

namespace choreo {

/// Frames at the listener's rate. Frame j is the dance at time j / fps.
struct OutputFrames {
  int64_t first_frame = 0;  ///< from time 0 on, at the output's rate
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;
};

/// Resamples a dance while it goes by: a frame between two of the model's waits for the later one
/// and is on the line (root) and the shortest arcs (joints) between them. At the model's rate
/// frames pass unchanged. Not thread-safe.
class OutputRate {
 public:
  /// `first_frame`: the model's first frame. `before`: the pose directly before it, when a dance
  /// resumes; output frames between the two then belong to this part.
  OutputRate(double model_fps, double output_fps, int64_t first_frame, std::optional<Pose> before);

  /// The output frames that the model's next frame completes: none or more.
  OutputFrames Push(const DanceFrame& frame);

 private:
  double model_fps_;
  double output_fps_;
  int64_t next_input_;
  int64_t next_output_ = 0;
  std::optional<Pose> last_;
};

}  // namespace choreo
