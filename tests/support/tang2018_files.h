#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "model/core/files/npy.h"
#include "model/fit/sources/position_clip.h"

namespace choreo {

/// Writes a recording as tang2018's NAME.npy: row 0 is the world centre, the others are relative to
/// it.
inline void WriteTang2018Npy(const std::filesystem::path& path, const PositionClip& clip) {
  const auto rows = static_cast<int64_t>(clip.joint_names.size()) + 1;
  NpyArray array{{static_cast<int64_t>(clip.frames.size()), rows, 3}, std::vector<float>()};
  auto& values = std::get<std::vector<float>>(array.values);
  for (const Eigen::Matrix3Xd& frame : clip.frames) {
    const Eigen::Vector3d centre = frame.rowwise().mean();
    for (int64_t row = 0; row < rows; ++row) {
      const Eigen::Vector3d point = row == 0 ? centre : frame.col(row - 1) - centre;
      for (const double value : point) values.push_back(static_cast<float>(value));
    }
  }
  WriteNpy(path, array);
}

}  // namespace choreo
