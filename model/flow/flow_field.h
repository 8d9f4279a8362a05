#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/core/running/slices.h"
#include "model/flow/window/flow_model.h"

namespace choreo {

/// F of one window at each step from noise to motion, guided by the labels. Model, network and
/// window must outlive this object.
class FlowField {
 public:
  /// `history`: the window's history. `features`: the window's features with labels and, for
  /// guidance, without. `keeps_effect`: the last step reuses the labels' effect on the previous
  /// step; beats affect neighbouring steps alike.
  FlowField(const FlowModelParts& model, const FlowNetwork& network, const FlowWindow& window,
            std::span<const Pose> history, std::span<const WindowFeatures> features,
            bool keeps_effect);

  int steps() const { return model_.config.steps; }
  double Angle(int step) const;

  /// F of the flow at w: z = size (cos noise + sin motion), size = 1 / (cos + sin). A slice is one
  /// evaluation of the network.
  Slices<Eigen::MatrixXd> Evaluate(const Eigen::MatrixXd& w, int step);

 private:
  // One set of inputs for the network.
  struct View {
    Eigen::MatrixXf frames, conditions;
  };
  Eigen::MatrixXd See(const View& view, const Eigen::MatrixXd& z, int step) const;
  double SizeAt(int step) const;

  const FlowModelParts& model_;
  const FlowNetwork& network_;
  const FlowWindow& window_;
  Eigen::MatrixXf mean_, poses_, joints_;
  std::vector<View> views_;
  bool keeps_effect_;
  Eigen::MatrixXd effect_;
};

}  // namespace choreo
