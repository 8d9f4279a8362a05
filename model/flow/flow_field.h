#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "model/core/slices.h"
#include "model/flow/flow_model.h"
#include "model/flow/flow_window.h"

namespace choreo {

/// The root path of the controls: which axes it fixes, and where, as residuals x and as white
/// coordinates z, both [3, w].
struct KnownPath {
  KnownPath(const WindowRequest& request, const FlowWindow& window);

  std::vector<int> axes;
  Eigen::MatrixXd x, z;
};

/// F of one window at each step from noise to motion, with guidance by its labels. Model, network
/// and window must outlive it.
class FlowField {
 public:
  FlowField(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
            const FlowWindow& window);

  int steps() const { return model_.config.steps; }
  double Angle(int step) const { return step * (std::numbers::pi / 2 / steps()); }

  /// F of the flow at w: z = size (cos noise + sin motion), size = 1 / (cos + sin). A slice is one
  /// evaluation of the network.
  Slices<Eigen::MatrixXd> Evaluate(const Eigen::MatrixXd& w, int step);

 private:
  // One input for the network.
  struct View {
    Eigen::MatrixXf frames, conditions;
  };
  void AddView(const WindowRequest& request);
  Eigen::MatrixXd See(const View& view, const Eigen::MatrixXd& z, int step) const;
  double SizeAt(int step) const;

  const FlowModelParts& model_;
  const FlowNetwork& network_;
  const FlowWindow& window_;
  std::vector<float> times_;  // per step
  Eigen::MatrixXf mean_, poses_, joints_;
  std::vector<View> views_;  // as labelled and, for guidance, without labels
  double guidance_;
  // Beats affect neighbouring steps alike, so the last step takes their effect from the one before.
  bool keeps_effect_;
  Eigen::MatrixXd effect_;
};

}  // namespace choreo
