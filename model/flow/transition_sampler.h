#pragma once

#include <optional>
#include <vector>

#include "model/flow/flow_sampler.h"

namespace choreo {

/// Samples a transition of any length as windows of at most config.window_frames, one after
/// another, each in its own canonical frame. Every window sees the transition's key if it is at
/// most kSightFrames away. A window that ends without it, where dancers hardly ever are, is sampled
/// again. Model and network must outlive it.
class TransitionSampler {
 public:
  /// `request` covers the whole transition, of at least one frame (frames <= to_key if there is a
  /// key). The model's TurnPrior chooses the way round to the key, unless the request does.
  TransitionSampler(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
                    const FlowNoise& noise);

  /// Makes the next evaluation of the network; true while more are left.
  bool Continue();
  /// All frames, once none is left, in the request's frame.
  std::vector<Pose> TakePoses();

 private:
  void BeginWindow();
  void EndWindow();
  // Whether to sample a window again, because it goes where dancers hardly ever are.
  bool Retakes(const std::vector<Pose>& poses);

  const FlowModelParts* model_;
  const FlowNetwork* network_;
  WindowRequest request_;
  FlowNoise noise_;
  int windows_;                // in total
  std::vector<Pose> emitted_;  // after the history
  int sampled_ = 0;            // finished windows
  int frames_ = 0;             // of these windows
  GroundFrame ground_;         // of the current window
  bool free_ = false;          // whether that window ends without a key
  int retakes_ = 0;            // of that window
  std::vector<Pose> nearest_;  // its take that stays nearest to the usual pose
  double nearest_deviation_ = 0;
  std::optional<WindowSampler> window_;
};

}  // namespace choreo
