#pragma once

#include "model/flow/energy_prior.h"

namespace choreo {

/// The liveliness of sampled windows as a function of the energy given to the network, which makes
/// calm windows too lively and lively ones too calm. Its inverse gives the energy for a wanted
/// liveliness. Measured in training on validation clips.
struct EnergyResponse {
  using Levels = EnergyPrior::Levels;

  /// Each part's EnergyLevel is danced = offset + slope * input. All zero: unknown.
  Levels offset = Levels::Zero(), slope = Levels::Zero();

  bool known() const { return slope.minCoeff() > 0; }
  /// The level to give to the network for a wanted one.
  double InputFor(int part, double wanted) const { return (wanted - offset[part]) / slope[part]; }
};

}  // namespace choreo
