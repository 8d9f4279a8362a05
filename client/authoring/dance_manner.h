#pragma once

#include <optional>
#include <string>

namespace choreo::authoring {

/// How to dance, as options, projects and reports state it: client::DanceConfig's members of these
/// names. Empty: not stated.
struct DanceManner {
  std::optional<double> temperature = {};
  std::string style = {};
  std::optional<double> music_dynamics = {}, variation = {};

  /// That of a client's request.
  static DanceManner Of(const auto& request) {
    return {request.temperature, request.style, request.music_dynamics, request.variation};
  }
  /// Sets it in a client's request.
  void SetIn(auto* request) const {
    request->temperature = temperature;
    request->style = style;
    request->music_dynamics = music_dynamics;
    request->variation = variation;
  }
};

}  // namespace choreo::authoring
