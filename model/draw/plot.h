#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

/// One line of a plot. It joins its points in the order given; a point that is not finite
/// interrupts it.
struct PlotSeries {
  std::string label;
  std::vector<double> x, y;  ///< of equal length
  /// The requested value beside the measured one: drawn dashed, in the colour of the series before
  /// it or, if it is the first, of the text.
  bool asked = false;
};

inline constexpr int kMinPlotPixels = 200, kMaxPlotPixels = 8192;  ///< per side

/// A line chart, or a bar chart if `x_names` is set. A line is dashed if an earlier line covers
/// half of it, so that both show.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool map = false;  ///< equal scales on both axes
  /// Includes 0 on the vertical axis, as bar charts always do.
  bool from_zero = false;
  /// Names of x = 0, 1, ..., where the series' bars stand side by side. As many names show as fit.
  /// Not with `map`.
  std::vector<std::string> x_names = {};
  int width = 1000;  ///< pixels
  int height = 600;
};

/// Draws axes, grid, lines and legend into a PNG. Throws Error(kInvalidArgument) for a size outside
/// its limits or a series whose x and y differ in length, Error(kInternal) if the file cannot be
/// written. Thread-safe.
void DrawPlot(const Plot& plot, const std::filesystem::path& png);

}  // namespace choreo
