#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/flow/energy_prior.h"
#include "model/flow/flow_model.h"
#include "model/flow/flow_window.h"

/// A window's energy: the known part, the sampled part, and what to ask of the network.
namespace choreo {

/// The energy that a window and its request state.
EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window);

/// Gives body parts without velocity factors an energy, sampled from the prior by `normals`: of the
/// levels, [kBodyParts], and of the curves, [kBodyParts, w].
void FillInEnergy(const FlowModelParts& model, const EnergyPrior::Levels& level_normals,
                  const Eigen::MatrixXd& curve_normals, double temperature,
                  const FlowWindow& window, WindowRequest* request);

/// Replaces requested levels by those that make the network dance them (EnergyResponse). The mean
/// motion, at temperature 0, needs no correction.
void CorrectLevels(const FlowModelParts& model, double temperature, WindowRequest* request);

/// The network responds to requested energy, but too weakly: finds how far each part's motion from
/// `before` over `poses` misses the energy `wanted`, and requests more or less of it. `more`:
/// logarithms of requested over wanted energy, changed from round to round. Returns the largest
/// miss of a part, an EnergyLevel.
double CorrectEnergy(const Skeleton& skeleton, const Pose& before, const std::vector<Pose>& poses,
                     const Eigen::MatrixXd& wanted, std::array<double, kBodyParts>& more,
                     ControlCurve& energy);

}  // namespace choreo
