#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/flow/flow_sampler.h"
#include "model/motion/contacts.h"

namespace choreo {

/// A plan: the poses that a model proposes for a whole transition, in its canonical frame.
struct SampledPlan {
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;  ///< of each
};

/// The plan of a transition on its way, slice by slice: windows of the continuous flow, in rounds
/// where energy is asked for, then the stages of the plan. Whoever makes a slice may stop behind
/// it. A function of model and spec alone.
class PlanSampling {
 public:
  /// The spec is valid; `styles` are the model's.
  PlanSampling(const TransitionSpec& spec, const std::vector<std::string>& styles);

  /// Makes the next slice; true while more are left. `info` is the network's.
  bool Continue(const ModelInfo& info, const FlowModelParts& parts, const FlowNetwork& network);
  /// Once none is left.
  SampledPlan TakePlan() { return std::move(plan_); }

 private:
  /// Takes what a round has come to; true while another one is to be sampled.
  bool EndRound(const FlowModelParts& parts);
  void Finish(const ModelInfo& info, const FlowModelParts& parts);

  // Of the spec:
  std::vector<Pose> history_;
  std::vector<double> beats_;
  bool keyed_, has_path_, has_heights_;

  WindowRequest request_;
  FlowNoise noise_;
  std::optional<TransitionSampler> sampler_;  // of this round; none: they are over
  SampledPlan plan_;

  // The network answers energy that is asked for, but by less. So what came of it is measured and,
  // as far as it missed, asked for again; the nearest is danced.
  bool in_rounds_;
  int round_ = 0;
  Eigen::MatrixXd wanted_;                   // energy, as it was asked for
  std::array<double, kBodyParts> more_ = {};  // logarithms of what is asked for over that
  double least_;                              // by how much the nearest missed
};

}  // namespace choreo
