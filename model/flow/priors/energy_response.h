#pragma once

#include "model/flow/priors/energy_prior.h"

namespace choreo {

/// The energy that windows have if an energy is requested from the network, which makes calm
/// windows too lively and lively ones too calm. The inverse gives the energy to request. Measured
/// in training on validation clips.
struct EnergyResponse {
  using Levels = EnergyPrior::Levels;

  /// For each part: danced EnergyLevel = offset + slope * requested level. All zero: unknown.
  Levels offset = Levels::Zero(), slope = Levels::Zero();

  bool known() const { return slope.minCoeff() > 0; }
  /// The level to request from the network for a wanted one.
  double InputFor(int part, double wanted) const { return (wanted - offset[part]) / slope[part]; }
};

}  // namespace choreo
