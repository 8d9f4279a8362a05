#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/plan/footwork_options.h"

namespace choreo {

/// How wrists turn (TurnWrists), measured by scripts/wrists.py on the training split of dancedb:
/// the spread about three axes, radians, without its trembling share.
struct WristOptions {
  double twist = 0.09;      ///< about the forearm
  double deviation = 0.35;  ///< towards the thumb
  double flexion = 0.41;    ///< towards the palm
  double memory = 1.45;     ///< radians by which shoulder and elbow turn in a wrist's time constant

  /// Throws Error(kInvalidArgument, field) for an option that is not above 0.
  void Check(const std::string& field) const;
};

void to_json(nlohmann::json& json, const WristOptions& options);
void from_json(const nlohmann::json& json, WristOptions& options);

/// Settings of the stages in model/plan (plan_stages.h). Stored in the model's checkpoint.
struct PlanOptions {
  /// How much time may speed up or slow down to align the dancer's beats with the music's.
  double accent = 0.5;
  double whole_accent = 1;       ///< seconds: shorter transitions get less: keys dominate them
  double fastest = 1.0 / 3;      ///< seconds between beats: faster beats have less effect
  double hinge_softness = 0.03;  ///< radians of bend over which a hinge stops softly
  FootworkOptions footwork = {};
  WristOptions wrists = {};

  /// Throws Error(kInvalidArgument, field) for options with which time could run backwards or a
  /// hinge would never stop.
  void Check(const std::string& field) const;
};

void to_json(nlohmann::json& json, const PlanOptions& options);
void from_json(const nlohmann::json& json, PlanOptions& options);

}  // namespace choreo
