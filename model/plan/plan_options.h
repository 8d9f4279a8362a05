#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/plan/footwork_options.h"

namespace choreo {

/// Settings of the stages in model/plan (plan_stages.h). Stored in the model's checkpoint.
struct PlanOptions {
  /// The share of her speed that a dancer gains on a beat and loses halfway to the next.
  double accent = 0.25;
  double key_accent = 0.75;   ///< additional gain at a key on a beat
  double whole_accent = 1;    ///< seconds: shorter transitions, dominated by keys, have less
  double fastest = 1.0 / 3;   ///< seconds between beats: faster ones have weaker accents
  double on_beat = 1.0 / 12;  ///< seconds between a key and a beat at which the key is on it
  /// Seconds of a transition: up to the first, keys have no accent of their own; from the second
  /// on, all of it.
  double no_key_accent = 1, whole_key_accent = 2;
  double hinge_softness = 0.03;  ///< radians of bend over which a hinge stops softly
  FootworkOptions footwork = {};

  /// Throws Error(kInvalidArgument, field) for options by which time could run backwards, or a
  /// hinge never stop.
  void Validate(const std::string& field) const;
};

void to_json(nlohmann::json& json, const PlanOptions& options);
void from_json(const nlohmann::json& json, PlanOptions& options);

}  // namespace choreo
