#include "model/evaluation/ratio_tables.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace choreo {
namespace {

// One column a length.
Table RatioTable(const std::vector<LengthFigures>& lengths, const std::string& heading) {
  Table table;
  table.label_headings = {heading};
  for (const LengthFigures& length : lengths)
    table.columns.push_back({std::to_string(length.frames) + " frames", 2});
  return table;
}

}  // namespace

Cell RatioToLine(const Figures& figures, const LengthFigures& length) {
  return Ratio(figures, &WindowFigures::l2p, length.line, &WindowFigures::l2p);
}

Plot RatioPlot(const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x_label = "frames";
  plot.y_label = "L2P / interpolation's";
  plot.from_zero = true;
  return plot;
}

void AddPoint(Plot* plot, const std::string& label, double x, double y) {
  auto series = std::ranges::find(plot->series, label, &PlotSeries::label);
  if (series == plot->series.end())
    series = plot->series.insert(series, PlotSeries{.label = label, .x = {}, .y = {}});
  series->x.push_back(x);
  series->y.push_back(y);
}

Table GenreTable(const ClipSet& set, const std::vector<LengthFigures>& lengths) {
  Table table = RatioTable(lengths, "genre");
  table.name = "genres_" + set.name;
  table.title = "L2P of the model over interpolation's, by genre, " + set.name;
  table.note = "Intervals over clips: none where a genre has but one.";
  Plot plot = RatioPlot(table.title);
  std::vector<std::string> genres = Genres(set);
  const bool several = genres.size() > 1;
  if (!several) genres.clear();
  genres.insert(genres.begin(), "all");
  for (const std::string& genre : genres) {
    TableRow row{{genre}, {}};
    for (const LengthFigures& length : lengths) {
      const auto of_genre = [&](const Figures& all) {
        Figures some;
        std::ranges::copy_if(all, std::back_inserter(some), [&](const WindowFigures& window) {
          return genre == "all" || GenreOf(set.clips[window.clip]) == genre;
        });
        return some;
      };
      row.cells.push_back(Ratio(of_genre(length.methods.at(kServed)), &WindowFigures::l2p,
                                of_genre(length.line), &WindowFigures::l2p));
      AddPoint(&plot, genre, length.frames, row.cells.back().value);
    }
    table.rows.push_back(row);
  }
  if (several) table.plot = plot;
  return table;
}

Table SampleTable(const ClipSet& set, const std::vector<LengthFigures>& lengths,
                  const EvalOptions& options) {
  char served[64];
  std::snprintf(served, sizeof(served), "as served, T = %.2f", options.temperature);
  Table table = RatioTable(lengths, "samples");
  table.name = "samples_" + set.name;
  table.title = "L2P of samples over interpolation's, " + set.name;
  table.note = "The best of several is the one nearest to the real dance, window by window.";
  Plot plot = RatioPlot(table.title);
  // The real dance lies on itself.
  table.rows.push_back({{"real"}, std::vector<Cell>(lengths.size(), Cell{0, {}})});
  const auto add = [&](const std::string& label, auto&& figures_of) {
    TableRow row{{label}, {}};
    for (const LengthFigures& length : lengths) {
      row.cells.push_back(RatioToLine(figures_of(length), length));
      AddPoint(&plot, label, length.frames, row.cells.back().value);
    }
    table.rows.push_back(row);
  };
  add(served, [](const LengthFigures& length) { return length.methods.at(kServed); });
  add("one, T = 1", [](const LengthFigures& length) { return length.hot; });
  add("best of " + std::to_string(options.best_of) + ", T = 1",
      [](const LengthFigures& length) { return length.best; });
  table.plot = plot;
  return table;
}

}  // namespace choreo
