#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace choreo {

/// Controls beside key poses and music, for models that support them; shared by client and server.
/// It has one member per row of kControls (motion/controls.h). Frames are at the model's rate.
/// dance/control_track.h validates them.
struct ControlRequest {
  /// Where the root goes: at least 2 points in time, metres, world frame. Either one in every
  /// frame, or a few with a smooth curve through them. Keys override it.
  struct RootPath {
    std::vector<int64_t> frames = {};          ///< ascending
    std::vector<Eigen::Vector2d> points = {};  ///< (x, z) at each
    std::vector<double> heights = {};          ///< of the root at each; empty: the model chooses
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
  };
  std::optional<RootPath> root_path = {};
  std::optional<VelocityFactors> velocity_factors = {};
};

}  // namespace choreo
