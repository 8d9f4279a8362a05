#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

/// One line of a plot. Points are joined in the order given; a point with a coordinate that is not
/// finite is left out and interrupts the line.
struct PlotSeries {
  std::string label;
  std::vector<double> x, y;  ///< of one length
  /// What was asked, beside what came of it: dashed, in the colour of the series before it; ahead
  /// of all others, in that of the text.
  bool asked = false;
};

inline constexpr int kLeastPlotPixels = 200, kMostPlotPixels = 8192;  ///< along a side

/// A line chart. A line of which half lies on an earlier one is dashed, so that both are
/// seen. With `x_names` a bar chart.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool map = false;  ///< a unit is as long up as to the right
  /// The vertical axis has 0, as that of bars always has.
  bool from_zero = false;
  /// Names of x = 0, 1, ..., as many of them as fit; there the series' bars stand side by side.
  /// Not with map.
  std::vector<std::string> x_names = {};
  int width = 1000;  ///< pixels
  int height = 600;
};

/// Draws axes, grid, lines and legend into a PNG. Throws Error(kInvalidArgument) for a size outside
/// its limits or a series whose x and y differ in length, Error(kInternal) where the file cannot be
/// written. Thread-safe.
void DrawPlot(const Plot& plot, const std::filesystem::path& png);

}  // namespace choreo
