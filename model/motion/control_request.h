#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace choreo {

/// Controls beside key poses and music, for models that support them; shared by client and server.
/// It has one member per row of kControls (motion/controls.h), with the fields of the API's message
/// of that name. Frames are at the model's rate. dance/control_track.h validates them.
struct ControlRequest {
  /// Where the root goes: at least 2 points in time, metres, world frame. Either one in every
  /// frame, or a few with a smooth curve through them. Keys override it.
  struct RootPath {
    std::vector<int64_t> frames = {};          ///< ascending
    std::vector<Eigen::Vector2d> points = {};  ///< (x, z) at each
    std::vector<double> heights = {};          ///< of the root at each; empty: the model chooses

    /// Calls `visit(name, field)` for each field, as the API calls it.
    static void VisitFields(auto& path, const auto& visit) {
      visit("frames", path.frames);
      visit("points", path.points);
      visit("heights", path.heights);
    }
  };
  /// The speeds of body parts, as factors or directly. Interpolated between rows; outside, the
  /// nearest row holds.
  struct VelocityFactors {
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
  };
  std::optional<RootPath> root_path = {};
  std::optional<VelocityFactors> velocity_factors = {};

  /// Calls `visit(row, control)` for each control, given or not; `row`: its number in kControls.
  static void VisitControls(auto& request, const auto& visit) {
    visit(0, request.root_path);
    visit(1, request.velocity_factors);
  }
};

}  // namespace choreo
