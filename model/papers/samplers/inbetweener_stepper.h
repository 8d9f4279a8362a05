#pragma once

#include <Eigen/Core>
#include <utility>

#include "model/papers/networks/inbetweener.h"
#include "model/papers/samplers/flow_stepper.h"

namespace choreo {

/// Steps the baseline without a flow, by LibTorch on the CPU. It draws no noise and has no
/// likelihood.
class InbetweenerStepper : public FlowStepper {
 public:
  /// `model`: in eval mode.
  explicit InbetweenerStepper(Inbetweener model) : model_(std::move(model)) {}

  void Begin(Eigen::MatrixXf conditions) override;
  void Step(FlowFrame* frame) override;

 private:
  Inbetweener model_;
  Eigen::MatrixXf conditions_;
  LstmState state_;
};

}  // namespace choreo
