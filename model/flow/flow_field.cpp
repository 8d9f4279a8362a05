#include "model/flow/flow_field.h"

#include <cmath>
#include <utility>

#include "model/flow/window_features.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"

namespace choreo {

KnownPath::KnownPath(const WindowRequest& request, const FlowWindow& window) {
  const ControlCurve& path = request.controls[kRootPath];
  if (!path.IsGiven()) return;
  axes = {0, 2};
  if (path.IsRequested(kPathHeight)) axes.push_back(kPathHeight);
  x = path.values.colwise() - request.history.back().root_position;
  x -= window.mean().topRows<3>();
  z.resize(3, x.cols());
  for (int axis = 0; axis < 3; ++axis)
    z.row(axis) = window.Whiten(axis, x.row(axis).transpose()).transpose();
}

FlowField::FlowField(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
                     const FlowWindow& window)
    : model_(model), network_(network), window_(window) {
  for (int step = 0; step < model.config.steps; ++step)
    times_.push_back(static_cast<float>(SizeAt(step) * std::sin(Angle(step))));
  const auto tau = static_cast<Eigen::Index>(request.history.size());
  mean_.resize(model.prior.dimensions(), tau + window.frames());
  mean_ << window.history().cast<float>(), window.mean().cast<float>();
  poses_ = mean_;
  joints_.resize(3 * model.skeleton.joints(), mean_.cols());
  for (Eigen::Index i = 0; i < tau; ++i) {
    const Pose& pose = request.history[static_cast<size_t>(i)];
    joints_.col(i) = JointPositions(model.skeleton, pose).reshaped().cast<float>();
  }
  const bool labelled = !request.beats.empty() || request.style >= 0;
  keeps_effect_ = request.style < 0;
  guidance_ = labelled ? model.config.guidance : 1;
  AddView(request);
  request.beats.clear();
  request.style = -1;
  if (guidance_ != 1) AddView(request);
}

Slices<Eigen::MatrixXd> FlowField::Evaluate(const Eigen::MatrixXd& w, int step) {
  const Eigen::MatrixXd z = SizeAt(step) * w;
  const Eigen::MatrixXd x = window_.Colour(z);
  poses_.rightCols(x.cols()) = (window_.mean() + x).cast<float>();
  joints_.rightCols(x.cols()) = window_.PlaceJoints(model_.skeleton, x);
  const Eigen::MatrixXd f = See(views_.front(), z, step);
  co_await Pause();
  if (views_.size() == 1) co_return f;
  if (keeps_effect_ && step > 0 && step + 1 == steps()) co_return f + (guidance_ - 1) * effect_;
  const Eigen::MatrixXd plain = See(views_.back(), z, step);
  co_await Pause();
  effect_ = f - plain;
  co_return guidance_* f + (1 - guidance_) * plain;
}

Eigen::MatrixXd FlowField::See(const View& view, const Eigen::MatrixXd& z, int step) const {
  return network_
      .Evaluate(z.cast<float>(), poses_, joints_, mean_, view.frames, view.conditions.col(step))
      .cast<double>();
}

void FlowField::AddView(const WindowRequest& request) {
  WindowFeatures seen =
      DescribeWindow(model_.skeleton, model_.config, model_.prior, request, window_);
  views_.push_back({std::move(seen.frames), network_.Condition(seen.whole, times_)});
}

double FlowField::SizeAt(int step) const {
  return 1 / (std::cos(Angle(step)) + std::sin(Angle(step)));
}

}  // namespace choreo
