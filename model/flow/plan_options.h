#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/flow/footwork_options.h"

namespace choreo {

/// How far the stages of model/plan (plan_stages.h) go with what a network proposes. Stored in its
/// checkpoint.
struct PlanOptions {
  /// On a beat a dancer gains this share of her speed, and loses it half way to the next.
  double accent = 0.25;
  double key_accent = 0.75;   ///< gained besides on a key that stands on a beat
  double whole_accent = 1;    ///< seconds: shorter transitions, which keys rule, have less
  double fastest = 1.0 / 3;   ///< seconds between beats: faster ones are accented less
  double on_beat = 1.0 / 12;  ///< seconds between a key and the beat that it stands on, at most
  /// Seconds of a transition: up to the one a key has no accent of its own, from the other on all.
  double no_key_accent = 1, whole_key_accent = 2;
  double hinge_softness = 0.03;  ///< radians of bend, over which a hinge is led to a stop
  FootworkOptions footwork = {};

  /// Throws Error(kInvalidArgument, field) where time could run backwards, or a hinge never stop.
  void Validate(const std::string& field) const;
};

void to_json(nlohmann::json& json, const PlanOptions& options);
void from_json(const nlohmann::json& json, PlanOptions& options);

}  // namespace choreo
