#include "model/flow/flow_field.h"

#include <cmath>
#include <numbers>

#include "model/motion/kinematics/kinematics.h"

namespace choreo {

FlowField::FlowField(const FlowModelParts& model, const FlowNetwork& network,
                     const FlowWindow& window, std::span<const Pose> history,
                     std::span<const WindowFeatures> features, bool keeps_effect)
    : model_(model), network_(network), window_(window), keeps_effect_(keeps_effect) {
  mean_.resize(model.prior.dimensions(), std::ssize(history) + window.frames());
  mean_ << window.history().cast<float>(), window.mean().cast<float>();
  poses_ = mean_;
  joints_.resize(3 * model.skeleton.joints(), mean_.cols());
  for (Eigen::Index i = 0; i < std::ssize(history); ++i) {
    const Pose& pose = history[static_cast<size_t>(i)];
    joints_.col(i) = JointPositions(model.skeleton, pose).reshaped().cast<float>();
  }
  std::vector<float> times;
  for (int step = 0; step < steps(); ++step)
    times.push_back(static_cast<float>(SizeAt(step) * std::sin(Angle(step))));
  // Views that differ in their frames alone have the same condition.
  for (const WindowFeatures& seen : features) {
    const bool is_same = !views_.empty() && features.front().whole == seen.whole;
    views_.push_back(
        {seen.frames, is_same ? views_.front().conditions : network.Condition(seen.whole, times)});
  }
}

Slices<Eigen::MatrixXd> FlowField::Evaluate(const Eigen::MatrixXd& w, int step) {
  const Eigen::MatrixXd z = SizeAt(step) * w;
  const Eigen::MatrixXd x = window_.Colour(z);
  poses_.rightCols(x.cols()) = (window_.mean() + x).cast<float>();
  joints_.rightCols(x.cols()) = window_.PlaceJoints(model_.skeleton, x);
  const Eigen::MatrixXd f = See(views_.front(), z, step);
  co_await Pause();
  if (views_.size() == 1) co_return f;
  const double guidance = model_.config.guidance;
  if (keeps_effect_ && step > 0 && step + 1 == steps()) co_return f + (guidance - 1) * effect_;
  const Eigen::MatrixXd plain = See(views_.back(), z, step);
  co_await Pause();
  effect_ = f - plain;
  const Eigen::MatrixXd guided = guidance * f + (1 - guidance) * plain;
  co_return guided;
}

Eigen::MatrixXd FlowField::See(const View& view, const Eigen::MatrixXd& z, int step) const {
  return network_
      .Evaluate(z.cast<float>(), poses_, joints_, mean_, view.frames, view.conditions.col(step))
      .cast<double>();
}

double FlowField::Angle(int step) const { return step * (std::numbers::pi / 2 / steps()); }

double FlowField::SizeAt(int step) const {
  return 1 / (std::cos(Angle(step)) + std::sin(Angle(step)));
}

}  // namespace choreo
