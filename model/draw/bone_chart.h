#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

inline constexpr size_t kMostChartBones = 400;

/// A rig's joint in a chart.
struct ChartBone {
  std::string name;
  Eigen::Vector3d place;
  int parent = -1;    ///< among these; -1: none
  std::string means;  ///< what it is taken for; empty: nothing
};

/// Draws a rig from its front (from +Z, Y up) with the names of its joints beside it; those that
/// are taken for something in colour, with what. Throws Error(kInvalidArgument) for none and for
/// more than kMostChartBones, which no picture shows; Error(kInternal) where the file cannot be
/// written.
void DrawBoneChart(const std::vector<ChartBone>& bones, const std::filesystem::path& png);

}  // namespace choreo
