#pragma once

#include <Eigen/Core>

#include "model/motion/skeleton.h"

namespace choreo {

/// [joints] The share of the body's mass at each joint: positions * weights is the centre of mass,
/// and the weights sum to 1. A segment's mass lies on the line between two joints. Masses and
/// centres are those of de Leva (1996, "Adjustments to Zatsiorsky-Seluyanov's segment inertia
/// parameters", Tables 4 and 5), the mean of women's and men's. Wrists and hands are whatever
/// descends from elbows. Empty if the skeleton lacks a role, wrists, or a joint called "head".
Eigen::VectorXd MassWeights(const Skeleton& skeleton);

}  // namespace choreo
