#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace choreo {

/// How a plan is put on its feet (model/plan/footwork.h). Stored in the model's checkpoint.
struct FootworkOptions {
  double step_cost = 0.05;    ///< of a step: so far toes leave the plan for a frame, square metres
  double flight_cost = 0.3;   ///< of a frame without a foot on the floor, likewise
  double shortest_step = 0.15;  ///< seconds in the air
  double longest_flight = 0.4;  ///< seconds without a foot on the floor
  /// The pelvis leaves the plan with an acceleration of so many m/s² as soon as ...
  double acceleration = 2;
  double offset = 0.10;   ///< ... it leaves it by so many metres, ...
  double reach = 0.01;    ///< ... legs are so many metres too short for where their feet stand, ...
  double balance = 0.05;  ///< ... or the zero moment point is so many metres outside of the feet
  double sole = 0.06;     ///< metres that a foot carries around its toes and ankle

  /// Throws Error(kInvalidArgument, field) for an option that is not above 0.
  void Validate(const std::string& field) const;
};

void to_json(nlohmann::json& json, const FootworkOptions& options);
void from_json(const nlohmann::json& json, FootworkOptions& options);

}  // namespace choreo
