#pragma once

#include <optional>
#include <vector>

#include "model/flow/flow_sampler.h"

namespace choreo {

/// A transition of any length on its way: windows of at most config.window_frames, sampled one
/// after another, each in its own canonical frame; their key is the transition's, however far it
/// is. Model and network must outlive it.
class TransitionSampler {
 public:
  /// `request` is of the whole transition (frames == to_key where there is a key); at least a
  /// frame. Which way round to turn to the key the model's TurnPrior says, unless the request does.
  TransitionSampler(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
                    const FlowNoise& noise);

  /// Makes the next evaluation of the network; true while more are left.
  bool Continue();
  /// All frames, once none is left, in the request's frame.
  std::vector<Pose> TakePoses();

 private:
  void BeginWindow();
  void EndWindow();

  const FlowModelParts* model_;
  const FlowNetwork* network_;
  WindowRequest request_;
  FlowNoise noise_;
  int windows_;                // in all
  std::vector<Pose> emitted_;  // behind the history
  int sampled_ = 0;            // windows that are done
  int frames_ = 0;             // of those
  GroundFrame ground_;         // of the window that is under way
  std::optional<WindowSampler> window_;
};

/// All of it at once.
std::vector<Pose> SampleTransition(const FlowModelParts& model, const FlowNetwork& network,
                                   const WindowRequest& request, const FlowNoise& noise);

}  // namespace choreo
