#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "client/dance_messages.h"
#include "model/motion/kinematics/canonical.h"

namespace choreo::authoring {

inline constexpr double kMaxFacing = 360;  ///< degrees, either way

/// Where on the floor to put a pose, and which way to face it. Empty members leave it as it is.
struct Placing {
  std::optional<Eigen::Vector2d> place = {};  ///< x and z, metres
  std::optional<double> facing = {};          ///< degrees about +Y: 90 is along x

  bool IsGiven() const { return place || facing; }
  /// The ground frame, after placing, of a pose whose ground frame is `from`.
  GroundFrame From(GroundFrame from) const;
};

/// Reads the members place and facing of a key. Throws Error(kInvalidArgument), naming the field.
Placing ReadPlacing(const nlohmann::json& value, const std::string& field);

/// Moves a pose over the floor so that its root is above the place, and turns it there to the
/// facing. Throws Error(kInvalidArgument, field) for a place if the key has no root position: the
/// root's height is unknown.
void PlaceRoot(const Placing& placing, const std::string& field, client::KeyPose* key);

}  // namespace choreo::authoring
