#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Kinetic features of a motion (Onuma et al. 2008, "FMDistance"), [3 * joints], for FID_k and
/// Div_k (Li et al. 2021): each joint's mean horizontal and vertical kinetic energy, (m/s)^2 for
/// unit mass, and mean acceleration, m/s^2. As usual, velocities and accelerations are averaged
/// over steps within two frames to reduce noise. Needs at least three frames.
Eigen::VectorXd KineticFeatures(const JointTrack& track, double fps);

/// Geometric features of a motion (Müller et al. 2005), [32], for FID_g and Div_g: the share of
/// frames in which a statement about the body is true, such as "the left knee is bent". Statements
/// and thresholds, in units of the dancer's upper arm, shoulders and hips, are fairmotion's. Needs
/// at least two frames and HasGeometricFeatures.
Eigen::VectorXd GeometricFeatures(const Skeleton& skeleton, const JointTrack& track, double fps);

/// Whether the skeleton has the joints that the statements use.
bool HasGeometricFeatures(const Skeleton& skeleton);

}  // namespace choreo
