#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/plan/footwork_options.h"

namespace choreo {

/// Settings of the stages in model/plan (plan_stages.h). Stored in the model's checkpoint.
struct PlanOptions {
  /// How much time may speed up or slow down to align the dancer's beats with the music's.
  double accent = 0.5;
  double whole_accent = 1;       ///< seconds: shorter transitions get less: keys dominate them
  double fastest = 1.0 / 3;      ///< seconds between beats: faster beats have less effect
  double hinge_softness = 0.03;  ///< radians of bend over which a hinge stops softly
  FootworkOptions footwork = {};

  /// Throws Error(kInvalidArgument, field) for options with which time could run backwards or a
  /// hinge would never stop.
  void Check(const std::string& field) const;
};

void to_json(nlohmann::json& json, const PlanOptions& options);
void from_json(const nlohmann::json& json, PlanOptions& options);

}  // namespace choreo
