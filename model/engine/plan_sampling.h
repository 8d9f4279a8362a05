#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/flow/transition_sampler.h"
#include "model/motion/contacts.h"

namespace choreo {

/// A plan: the poses that a model proposes for a whole transition, in its canonical frame.
struct SampledPlan {
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;  ///< of each
};

/// The plan of a transition on its way, slice by slice: evaluations of the continuous flow, in
/// rounds where energy is asked for, then the stages of the plan. Whoever makes a slice may stop
/// behind it. A function of model and spec alone.
class PlanSampling {
 public:
  /// The spec is valid; model, parts and network must outlive it.
  PlanSampling(const ModelInfo& model, const FlowModelParts& parts, const FlowNetwork& network,
               const TransitionSpec& spec);

  /// Makes the next slice; true while more are left.
  bool Continue();
  /// Once none is left.
  SampledPlan TakePlan() { return std::move(plan_); }

 private:
  /// Takes what a round has come to; true while another one is to be sampled.
  bool EndRound();
  void Finish();

  const ModelInfo* model_;
  const FlowModelParts* parts_;
  const FlowNetwork* network_;
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
  Eigen::MatrixXd wanted_;                    // energy, as it was asked for
  std::array<double, kBodyParts> more_ = {};  // logarithms of what is asked for over that
  double least_;                              // by how much the nearest missed
};

}  // namespace choreo
