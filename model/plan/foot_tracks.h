#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/plan/contact_plan.h"
#include "model/plan/footwork.h"
#include "model/plan/pelvis_offset.h"

/// Measures a plan's feet and balance before footwork. Pure functions.
namespace choreo {

/// The feet of a skeleton with legs, and their heights at rest, metres.
struct FeetAtRest {
  explicit FeetAtRest(const Skeleton& skeleton);

  std::array<Leg, 2> legs;
  std::array<double, 2> toes_rest, ankle_rest;
  Eigen::RowVectorXd clearance;  ///< FloorClearance
};

/// The points (x, z), other than feet, at which the floor carries a body with these joint
/// positions.
std::vector<Eigen::Vector2d> CarriersOf(const Skeleton& skeleton, const FeetAtRest& feet,
                                        const Eigen::Matrix3Xd& joints);

/// The centre of mass, beginning with the two frames before the plan's first.
std::vector<BodyCentre> CentresOfMass(const FootworkContext& context,
                                      const std::vector<Pose>& plan);

/// The tracks of both feet of a plan. `placements`: its joints' positions. `carriers`: its
/// CarriersOf. `centres`: its CentresOfMass.
std::array<FootTrack, 2> TrackFeet(const FootworkContext& context, const FeetAtRest& feet,
                                   const std::vector<Pose>& plan,
                                   const std::vector<JointPlacement>& placements,
                                   const std::vector<std::vector<Eigen::Vector2d>>& carriers,
                                   const std::vector<BodyCentre>& centres);

}  // namespace choreo
