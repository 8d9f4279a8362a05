#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/flow/priors/energy_prior.h"
#include "model/flow/window/flow_model.h"
#include "model/flow/window/flow_window.h"

/// A window's energy: the known part, the sampled part, and the energy to request from the network.
namespace choreo {

/// The known energy of a window and its request.
EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window);

/// Samples an energy from the prior for body parts without velocity factors. Standard normal
/// numbers: `level_normals` [kBodyParts], `curve_normals` [kBodyParts, w].
void FillInEnergy(const FlowModelParts& model, const EnergyPrior::Levels& level_normals,
                  const Eigen::MatrixXd& curve_normals, double temperature,
                  const FlowWindow& window, WindowRequest* request);

/// Replaces wanted levels by the levels to request for them (EnergyResponse). The mean motion, at
/// temperature 0, needs no correction.
void CorrectLevels(const FlowModelParts& model, double temperature, WindowRequest* request);

/// Adjusts the requested energy, to which the network responds too weakly. Computes by how much
/// each part's motion from `before` over `poses` misses the energy `wanted`, and requests more or
/// less. `more`: logarithms of requested over wanted energy, changed from round to round. Returns
/// the largest miss of a part, an EnergyLevel.
double CorrectEnergy(const Skeleton& skeleton, const Pose& before, const std::vector<Pose>& poses,
                     const Eigen::MatrixXd& wanted, std::array<double, kBodyParts>& more,
                     ControlCurve& energy);

}  // namespace choreo
