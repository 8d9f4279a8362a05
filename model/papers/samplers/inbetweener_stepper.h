#pragma once

#include <Eigen/Core>
#include <utility>

#include "model/papers/networks/inbetweener.h"
#include "model/papers/samplers/flow_stepper.h"

namespace choreo {

/// Runs the baseline without a flow, with LibTorch on the CPU. It has neither noise nor likelihood.
class InbetweenerStepper : public FlowStepper {
 public:
  /// `model`: in eval mode.
  explicit InbetweenerStepper(Inbetweener model) : model_(std::move(model)) {}

  void StartTransition(Eigen::MatrixXf conditions) override;
  void Step(FlowFrame* frame) override;

 private:
  Inbetweener model_;
  Eigen::MatrixXf conditions_;
  LstmState state_;
};

}  // namespace choreo
