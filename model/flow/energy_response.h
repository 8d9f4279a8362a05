#pragma once

#include "model/flow/energy_prior.h"

namespace choreo {

/// The energy that sampled windows have, as a function of the energy asked of the network. The
/// network makes calm windows too lively and lively ones too calm. The inverse says what to ask of
/// it. Measured in training on validation clips.
struct EnergyResponse {
  using Levels = EnergyPrior::Levels;

  /// Each part's EnergyLevel is danced = offset + slope * input. All zero: unknown.
  Levels offset = Levels::Zero(), slope = Levels::Zero();

  bool known() const { return slope.minCoeff() > 0; }
  /// The level to give to the network for a wanted one.
  double InputFor(int part, double wanted) const { return (wanted - offset[part]) / slope[part]; }
};

}  // namespace choreo
