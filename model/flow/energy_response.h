#pragma once

#include "model/flow/energy_prior.h"

namespace choreo {

/// How lively windows come out by what the network is told: it makes calm ones too lively and
/// lively ones too calm. What is wanted is told by the inverse. Training measures it, on validation
/// clips.
struct EnergyResponse {
  using Levels = EnergyPrior::Levels;

  /// Of each part's EnergyLevel: danced = offset + slope told. All zero: unknown.
  Levels offset = Levels::Zero(), slope = Levels::Zero();

  bool known() const { return slope.minCoeff() > 0; }
  /// What to tell a network of which that level is wanted.
  double Told(int part, double wanted) const { return (wanted - offset[part]) / slope[part]; }
};

}  // namespace choreo
