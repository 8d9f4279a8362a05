#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/core/running/slices.h"
#include "model/flow/window/flow_model.h"
#include "model/flow/window/flow_window.h"
#include "model/plan/sampler.h"
#include "model/plan/takes.h"
#include "model/plan/transition_noise.h"

namespace choreo {

/// The temperature interpolates from the mean motion (0, in one step) to a sampled one (1) and
/// beyond, at most to this. Noise itself is never scaled, because the network would take it for a
/// calm dancer.
inline constexpr double kMaxFlowTemperature = 1.25;

/// Samples one window: from noise at t = 0 to motion at t = 1 along dz/dt = (2t - 1)/a z +
/// F/sqrt(a), a = t² + (1 - t)² (flow matching, Lipman et al. 2023). With w = z/sqrt(a) over the
/// angle arctan(t/(1 - t)) this is dw = F, solved by second-order Adams-Bashforth steps. However
/// few the steps, motion keeps the energy that the prior expects. The poses [w] are in the
/// request's frame. Meets a requested path exactly. Parts without velocity factors take their
/// energy from the energy prior and curve: the mean at temperature 0, else a sample. A slice is one
/// evaluation of the network. Model and network must outlive the slices.
Slices<std::vector<Pose>> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                                       WindowRequest request, TransitionNoise noise);

/// Samples a transition of any length as windows of at most config.window_frames, one after
/// another, each in its own canonical frame. Every window sees the transition's key if it is at
/// most kSightFrames away. While spare frames are left, samples a window again that is faster than
/// people are or ends, without a key, in a pose that dancers hardly ever have. `request`: the whole
/// transition, at least one frame; frames <= to_key if there is a key. The model's TurnPrior
/// chooses the direction of the turn to the key, unless the request does.
Slices<std::vector<Pose>> SampleTransition(const FlowModelParts& model, const FlowNetwork& network,
                                           WindowRequest request, TransitionNoise noise,
                                           SpareFrames* spare);

/// Samples the continuous flow. A slice is one evaluation of its network. If energy is requested,
/// samples several rounds while spare frames are left. Samples one window after another, so a
/// transition's bits depend on nothing else. It hears beats, not sound. Plans have no contacts.
/// Made by samplers.h.
class ContinuousFlowSampler : public Sampler {
 public:
  ContinuousFlowSampler(ModelInfo info, std::string device,
                        std::shared_ptr<const FlowModelParts> parts,
                        std::shared_ptr<const FlowNetwork> network);

  Slices<Plan> Sample(const ValidSpec& spec) override;

 private:
  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
};

}  // namespace choreo
