#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace choreo {

// Control requests, with the fields of the API's messages. `frames` are at the model's rate.
// dance/controls/control_track.h validates requests.

/// Where the root goes: at least 2 points in time, metres, world frame. Either one in every
/// frame, or a few with a smooth curve through them. Keys override it.
struct RootPath {
  std::vector<int64_t> frames = {};          ///< ascending
  std::vector<Eigen::Vector2d> points = {};  ///< (x, z) at each
  std::vector<double> heights = {};          ///< of the root at each; empty: the model chooses

  /// Calls visit(API name, field) for each field.
  static void VisitFields(auto& path, const auto& visit) {
    visit("frames", path.frames);
    visit("points", path.points);
    visit("heights", path.heights);
  }
  /// Whether each frame has a point and, if there are heights, a height.
  bool IsWhole() const {
    return frames.size() >= 2 && points.size() == frames.size() &&
           (heights.empty() || heights.size() == frames.size());
  }
};

/// The speeds of body parts, as factors or directly. Interpolated between rows; outside, the
/// nearest row holds.
struct VelocityRequest {
  std::vector<int64_t> frames = {};  ///< of each row, ascending; empty: one row for all frames
  /// The part of each column, one of kBodyPartNames, without repetition; empty: one column for
  /// all parts.
  std::vector<std::string> parts = {};
  std::vector<double> factors = {};  ///< [rows, columns] multipliers of the reference, 0 to 10
  std::vector<double> speeds = {};   ///< [rows, columns] metres a frame, 0 to 0.5
  std::string reference = {};        ///< empty: the model's first; empty with speeds

  static void VisitFields(auto& velocity, const auto& visit) {
    visit("frames", velocity.frames);
    visit("parts", velocity.parts);
    visit("factors", velocity.factors);
    visit("speeds", velocity.speeds);
    visit("reference", velocity.reference);
  }
  /// Whether there is a value for each row and column.
  bool IsWhole() const {
    const size_t rows = std::max<size_t>(1, frames.size());
    return (factors.empty() || speeds.empty()) &&
           factors.size() + speeds.size() == rows * std::max<size_t>(1, parts.size());
  }
};

/// One `Of<Request>` member per control, in the order of kControls (motion/controls/controls.h).
template <template <typename Request> typename Of>
struct EachControl {
  using RootPath = choreo::RootPath;
  using VelocityFactors = VelocityRequest;

  Of<RootPath> root_path = {};
  Of<VelocityFactors> velocity_factors = {};

  /// Calls visit(row number, the member of each argument...) once per row.
  static void VisitControls(const auto& visit, auto&... each) {
    visit(0, each.root_path...);
    visit(1, each.velocity_factors...);
  }
};

/// Controls beside key poses and music, for models that support them; shared by client and server.
using ControlRequest = EachControl<std::optional>;

}  // namespace choreo
