#include "model/flow/priors/energy_prior.h"

#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

// Visits all measurements, part by part.
template <typename Prior, typename Visit>
void VisitNumbers(Prior& prior, Visit visit) {
  visit(prior.least);
  visit(prior.most);
  visit(prior.usual_way);
  visit(prior.usual_way_in_world);
  visit(prior.keyed);
  visit(prior.free);
  visit(prior.spread);
  visit(prior.styles);
}

}  // namespace

EnergyPrior::Inputs EnergyPrior::Describe(const Known& known) const {
  constexpr int kHalf = kInputs / 2;
  Inputs inputs;
  inputs.head<kHalf>().setZero();
  inputs[0] = 1;
  // The past counts only with a key. Without one it is the dance's own, and its energy would fade
  // or escalate.
  if (known.key)
    inputs.segment<kHalf - 1>(1) << std::log(std::max(known.surprise, 1e-6)), known.history,
        known.way.value_or(usual_way), known.way_in_world.value_or(usual_way_in_world);
  inputs.tail<kHalf>() = std::log2(known.frames / double{kTypicalFrames}) * inputs.head<kHalf>();
  return inputs;
}

EnergyPrior::Levels EnergyPrior::Sample(const Known& known, const Levels& normal) const {
  const Inputs inputs = Describe(known).cwiseMax(least).cwiseMin(most);
  Levels levels = (known.key ? keyed : free) * inputs + spread * normal;
  if (known.style >= 0) levels += styles.col(known.style);
  return Bound(levels);
}

Eigen::MatrixXd EnergyPrior::Bound(const Eigen::MatrixXd& levels) const {
  const Levels floor = least.segment<kBodyParts>(kHistoryInput), ceiling = MostEnergy();
  return levels.cwiseMax(floor.replicate(1, levels.cols()))
      .cwiseMin(ceiling.replicate(1, levels.cols()));
}

std::vector<double> EnergyPrior::ToNumbers() const {
  std::vector<double> numbers;
  VisitNumbers(*this, [&](const auto& part) {
    numbers.insert(numbers.end(), part.data(), part.data() + part.size());
  });
  return numbers;
}

void EnergyPrior::SetNumbers(std::span<const double> numbers) {
  auto next = numbers.begin();
  VisitNumbers(*this, [&](auto& part) {
    std::copy_n(next, part.size(), part.data());
    next += part.size();
  });
}

}  // namespace choreo
