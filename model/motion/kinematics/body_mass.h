#pragma once

#include <Eigen/Core>

#include "model/motion/skeleton.h"

namespace choreo {

/// Returns the share of the body's mass at each joint, [joints]. They sum to 1, and positions *
/// weights is the centre of mass. A segment's mass lies on the line between two joints. Segment
/// masses and centres are the means of women's and men's in de Leva (1996, "Adjustments to
/// Zatsiorsky-Seluyanov's segment inertia parameters", Tables 4 and 5). All descendants of an elbow
/// count as wrist and hand. Empty if the skeleton lacks a role, wrists, or a joint called "head".
Eigen::VectorXd MassWeights(const Skeleton& skeleton);

}  // namespace choreo
