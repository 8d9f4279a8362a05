#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/evaluation/transition_judge.h"

namespace choreo {

/// All that was measured at one length.
struct LengthFigures {
  int frames = 0;
  std::vector<EvalWindow> windows;
  std::map<std::string, Figures> methods;
  Figures line;  ///< interpolation, whether or not it has a row
  Figures hot;   ///< one sample at temperature 1
  Figures best;  ///< the sample there that is nearest to the real dance, window by window
};

/// L2P over interpolation's.
Cell RatioToLine(const Figures& figures, const LengthFigures& length);

/// An empty chart of such ratios over lengths, and a point of it.
Plot RatioPlot(const std::string& title);
void AddPoint(Plot* plot, const std::string& label, double x, double y);

/// The judged model's ratio, genre by genre; drawn where there is more than one.
Table GenreTable(const ClipSet& set, const std::vector<LengthFigures>& lengths);

/// The ratios of real motion, of the model as served, at temperature 1, and of the best samples
/// there.
Table SampleTable(const ClipSet& set, const std::vector<LengthFigures>& lengths,
                  const EvalOptions& options);

}  // namespace choreo
