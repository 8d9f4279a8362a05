#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

inline constexpr size_t kMaxChartBones = 400;

/// A joint of a rig, as drawn in a chart.
struct ChartBone {
  std::string name;
  Eigen::Vector3d place;
  int parent = -1;    ///< index in the chart; -1: none
  std::string means;  ///< its assigned bone, or empty
};

/// Draws a rig from its front (from +Z, Y up) with its joints' names beside it; joints with an
/// assigned bone are coloured and named. Throws Error(kInvalidArgument) for no joints and for more
/// than kMaxChartBones, too many for a picture; Error(kInternal) if the file cannot be written.
void DrawBoneChart(const std::vector<ChartBone>& bones, const std::filesystem::path& png);

}  // namespace choreo
