#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

/// One line of a plot. Points are joined in the order given; a point with a coordinate that is not
/// finite (or, on a logarithmic axis, not above zero) is left out and interrupts the line.
struct PlotSeries {
  std::string label;
  std::vector<double> x, y;  ///< of one length
  /// What was asked, beside what came of it: dashed, in the colour of the series before it; ahead
  /// of all others, in that of the text.
  bool asked = false;
};

/// A line chart.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool log_y = false;
  bool map = false;  ///< a unit is as long up as to the right
  int width = 1000;  ///< pixels, 200 to 8192
  int height = 600;
};

/// Draws axes, grid, lines and legend into a PNG. Throws Error(kInvalidArgument) for a size outside
/// its limits or a series whose x and y differ in length, Error(kInternal) where the file cannot be
/// written. Thread-safe.
void DrawPlot(const Plot& plot, const std::filesystem::path& png);

}  // namespace choreo
