#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace choreo {

/// Settings of footwork (model/plan/footwork.h). Stored in the model's checkpoint.
struct FootworkOptions {
  /// Cost of a step, in the unit of the toes' squared distances from the plan, summed over frames:
  /// square metres.
  double step_cost = 0.05;
  double flight_cost = 0.3;     ///< cost of a frame without a foot on the floor, in the same unit
  double shortest_step = 0.15;  ///< seconds in the air
  double longest_flight = 0.4;  ///< seconds without a foot on the floor
  /// The pelvis's acceleration away from the plan, m/s², if ...
  double acceleration = 2;
  double offset = 0.10;  ///< ... that moves it by this many metres, ...
  double reach = 0.01;   ///< ... or legs are this many metres too short for their feet, ...
  /// ... or the centre of mass or the zero moment point is this many metres outside the feet
  double balance = 0.05;
  double sole = 0.06;  ///< metres that a foot supports around its toes and ankle

  /// Throws Error(kInvalidArgument, field) for an option that is not above 0.
  void Check(const std::string& field) const;
};

void to_json(nlohmann::json& json, const FootworkOptions& options);
void from_json(const nlohmann::json& json, FootworkOptions& options);

}  // namespace choreo
