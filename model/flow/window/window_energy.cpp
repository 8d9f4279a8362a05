#include "model/flow/window/window_energy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"

namespace choreo {
namespace {

constexpr double kAnswer = 0.6;  // share of additional energy that shows up in the motion
constexpr double kMaxLog = 1;    // bound of the logarithm of requested over wanted energy

// Whether a key fixes limbs: all joints except hands and feet, which carry at most one other joint.
bool FixesLimbs(const Skeleton& skeleton, const PoseMask& mask) {
  std::vector<int> carried(static_cast<size_t>(skeleton.joints()));
  for (int joint = skeleton.joints() - 1; joint >= 0; --joint) {
    const auto at = static_cast<size_t>(joint);
    if (carried[at] > 1 && !mask.Constrains(joint)) return false;
    if (joint > 0) carried[static_cast<size_t>(skeleton.parents[at])] += carried[at] + 1;
  }
  return true;
}

}  // namespace

EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window) {
  const auto level = [&](size_t part, double factor) {
    return EnergyLevel(factor, model.config.median_factors[part]);
  };
  // The motion to a key beyond the window does not predict the window's own energy.
  EnergyPrior::Known known{.key = request.target && request.to_key == request.frames,
                           .surprise = window.surprise(),
                           .frames = request.frames,
                           .style = request.style};
  const auto factors = MeanPartSpeeds(model.skeleton, request.history);
  for (size_t part = 0; part < factors.size(); ++part) {
    const auto row = static_cast<Eigen::Index>(part);
    known.history[row] = factors[part] > 0 ? level(part, factors[part])
                                           : model.energy.least[EnergyPrior::kHistoryInput + row];
  }
  if (!known.key || !FixesLimbs(model.skeleton, request.target->mask)) return known;
  const BodyPartWeights weights = WeighBodyParts(model.skeleton);
  const Eigen::Matrix3Xd from = JointPositions(model.skeleton, request.history.back());
  const Pose key = Masked(request.target->pose, request.target->mask, request.history.back());
  const Eigen::Matrix3Xd to = JointPositions(model.skeleton, key);
  const auto way = PartSpeeds(weights, from, to);
  const Eigen::VectorXd in_world = weights * (to - from).colwise().norm().transpose();
  known.way.emplace();
  if (request.target->mask.root_position) known.way_in_world.emplace();
  for (size_t part = 0; part < way.size(); ++part) {
    const auto row = static_cast<Eigen::Index>(part);
    (*known.way)[row] = level(part, way[part] / request.to_key);
    if (known.way_in_world)
      (*known.way_in_world)[row] = level(part, in_world[row] / request.to_key);
  }
  return known;
}

void FillInEnergy(const FlowModelParts& model, const EnergyPrior::Levels& level_normals,
                  const Eigen::MatrixXd& curve_normals, double temperature,
                  const FlowWindow& window, WindowRequest* request) {
  ControlCurve& energy_control = request->controls[kVelocityFactors];
  if (!energy_control.IsGiven()) {
    energy_control.values = Eigen::MatrixXd::Zero(kBodyParts, request->frames);
    energy_control.requested.assign(kBodyParts, false);
  }
  EnergyPrior::Levels levels = temperature * level_normals;
  Eigen::MatrixXd curves = temperature * curve_normals;
  // The history already contains the shift; do not add it again.
  EnergyPrior::Known known = KnownOfEnergy(model, *request, window);
  known.history.array() -= request->energy_shift.before;
  levels = model.energy.Sample(known, levels);
  const bool varies = model.curve.known();
  curves = varies ? model.curve.Sample(temperature * (known.history - levels), curves)
                  : Eigen::MatrixXd::Zero(kBodyParts, request->frames);
  curves.colwise() += levels;
  if (varies) curves = model.energy.Bound(curves);
  levels.array() += request->energy_shift.now;
  curves.array() += request->energy_shift.now;
  const EnergyPrior::Levels most = model.energy.MostEnergy();
  levels = levels.cwiseMin(most);
  for (int part = 0; part < kBodyParts; ++part) {
    if (energy_control.IsRequested(part)) continue;
    const double median = model.config.median_factors[static_cast<size_t>(part)];
    auto energy = energy_control.values.row(part);
    for (int i = 0; i < request->frames; ++i) energy[i] = EnergyFactor(curves(part, i), median);
    // Scales the curve so that its mean has the window's level.
    if (const double mean = energy.mean(); varies && mean > 0)
      energy *= EnergyFactor(levels[part], median) / mean;
    energy = energy.cwiseMin(EnergyFactor(most[part], median));
    energy_control.requested[static_cast<size_t>(part)] = true;
  }
}

void CorrectLevels(const FlowModelParts& model, double temperature, WindowRequest* request) {
  if (!model.response.known()) return;
  Eigen::MatrixXd& factors = request->controls[kVelocityFactors].values;
  for (int part = 0; part < kBodyParts; ++part) {
    const double median = model.config.median_factors[static_cast<size_t>(part)];
    const double wanted = factors.row(part).mean();
    if (wanted <= 0) continue;
    const double level = EnergyLevel(wanted, median);
    const double input = level + temperature * (model.response.InputFor(part, level) - level);
    // Stays within the range of training, unless the request itself leaves it.
    const double most = EnergyFactor(model.energy.MostEnergy()[part], median);
    for (double& energy : factors.row(part))
      energy = std::min(energy * (EnergyFactor(input, median) / wanted), std::max(energy, most));
  }
}

double CorrectEnergy(const Skeleton& skeleton, const Pose& before, const std::vector<Pose>& poses,
                     const Eigen::MatrixXd& wanted, std::array<double, kBodyParts>& more,
                     ControlCurve& energy) {
  std::vector<Pose> seen = {before};
  seen.insert(seen.end(), poses.begin(), poses.end());
  const auto danced = MeanPartSpeeds(skeleton, seen);
  const Eigen::VectorXd means = wanted.rowwise().mean();
  double most = 0;
  for (int part = 0; part < means.size(); ++part) {
    const auto at = static_cast<size_t>(part);
    if (!energy.IsRequested(part)) continue;
    const double missing = EnergyLevel(means[part], danced[at]);
    most = std::max(most, std::abs(missing));
    more[at] = std::clamp(more[at] + missing / kAnswer, -kMaxLog, kMaxLog);
    energy.values.row(part) = std::exp(more[at]) * wanted.row(part);
  }
  return most;
}

}  // namespace choreo
