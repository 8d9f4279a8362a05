#include "client/authoring/keys/placing.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/json_fields.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/rotation.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

Eigen::Vector2d PlaceIn(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != 2)
    throw InvalidArgument(field, Shown(value) + " is not [x, z], metres");
  return {JsonNumber(value[0], field + "[0]"), JsonNumber(value[1], field + "[1]")};
}

}  // namespace

GroundFrame Placing::From(GroundFrame from) const {
  if (place) from.origin = {place->x(), 0, place->y()};
  if (facing) from.heading = *facing / kDegrees;
  return from;
}

Placing ReadPlacing(const json& value, const std::string& field) {
  Placing placing;
  if (value.contains("facing")) {
    placing.facing = JsonNumber(value["facing"], field + ".facing");
    if (!(std::abs(*placing.facing) <= kMaxFacing)) {
      throw InvalidArgument(field + ".facing", Shown(value["facing"]) + " degrees, must be " +
                                                   Rounded(-kMaxFacing) + " to " +
                                                   Rounded(kMaxFacing));
    }
  }
  if (value.contains("place")) placing.place = PlaceIn(value["place"], field + ".place");
  return placing;
}

void PlaceRoot(const Placing& placing, const std::string& field, client::KeyPose* key) {
  if (!placing.IsGiven()) return;
  if (placing.place && !key->mask.root_position)
    throw InvalidArgument(field, "needs a root_position, which says how high the pose is");
  const GroundFrame from = GroundFrame::Of(key->pose);
  key->pose = placing.From(from).ToWorld(from.ToLocal(key->pose));
}

}  // namespace choreo::authoring
