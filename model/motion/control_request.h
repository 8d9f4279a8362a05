#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace choreo {

/// Wishes beside key poses and music, for models that take them, as a client asks for them and a
/// server dances them: a member for each row of kControls (motion/controls.h). Frames are counted
/// at the model's rate. What is no control is refused where it is danced (dance/control_track.h).
struct ControlRequest {
  /// Where the root goes: points in time, at least 2, metres, in the world. One in each frame, or
  /// few, which a smooth curve leads through. Keys win over it.
  struct RootPath {
    std::vector<int64_t> frames = {};          ///< ascending
    std::vector<Eigen::Vector2d> points = {};  ///< (x, z) at each
    std::vector<double> heights = {};          ///< of the root, at each; empty: as the model likes
  };
  /// How lively parts of the body are. Either factors or speeds. Between rows values are
  /// interpolated, outside the nearest holds.
  struct VelocityFactors {
    std::vector<int64_t> frames = {};  ///< of each row, ascending; empty: one row, for always
    /// Of each column, of kBodyPartNames, none twice; empty: one, for all.
    std::vector<std::string> parts = {};
    std::vector<double> factors = {};  ///< [rows, columns] multipliers of the reference, 0 to 10
    std::vector<double> speeds = {};   ///< [rows, columns] metres a frame, 0 to 0.5
    std::string reference = {};        ///< empty: the model's first; empty with speeds
  };
  std::optional<RootPath> root_path = {};
  std::optional<VelocityFactors> velocity_factors = {};
};

}  // namespace choreo
