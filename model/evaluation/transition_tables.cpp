#include "model/evaluation/transition_tables.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>

#include "model/evaluation/transition_judge.h"

namespace choreo {
namespace {

const Method& Served(const std::vector<Method>& methods) {
  return *std::ranges::find(methods, kServed, &Method::name);
}

// All that was measured at one length.
struct LengthFigures {
  int frames = 0;
  std::vector<EvalWindow> windows;
  std::map<std::string, Figures> methods;
  Figures line;  // interpolation, whether or not it has a row
  Figures hot, best;
};

Cell RatioToLine(const Figures& figures, const LengthFigures& length) {
  return Ratio(figures, &WindowFigures::l2p, length.line, &WindowFigures::l2p);
}

TableRow MethodRow(const std::string& method, const LengthFigures& length,
                   const RealFeatures& real) {
  const Figures& figures = length.methods.at(method);
  Pace pace;
  double npss = 0, weights = 0;
  for (const WindowFigures& window : figures) {
    pace.Add(window.pace);
    npss += window.npss_sum;
    weights += window.npss_weight;
  }
  const FeatureFigures kinetic = CompareFeatures(real.kinetic, figures, &WindowFigures::kinetic);
  const FeatureFigures geometric =
      CompareFeatures(real.geometric, figures, &WindowFigures::geometric);
  const auto mean = [&](double WindowFigures::*figure) {
    return Cell{Mean(figures, figure).value, {}};
  };
  return {{std::to_string(length.frames), method},
          {Mean(figures, &WindowFigures::l2p, 100), RatioToLine(figures, length),
           mean(&WindowFigures::l2q), Cell{weights > 0 ? npss / weights : NAN, {}},
           Cell{kinetic.distance, {}}, Cell{geometric.distance, {}}, Cell{kinetic.diversity, {}},
           Cell{geometric.diversity, {}}, mean(&WindowFigures::pfc),
           mean(&WindowFigures::skate_ratio), mean(&WindowFigures::p95_acceleration),
           Cell{Largest(figures, &WindowFigures::max_acceleration), {}},
           Cell{pace.median_jerk(), {}}, Cell{pace.median_speed(), {}}}};
}

Plot RatioPlot(const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x_label = "frames";
  plot.y_label = "L2P / interpolation's";
  return plot;
}

void AddPoint(Plot* plot, const std::string& label, double x, double y) {
  auto series = std::ranges::find(plot->series, label, &PlotSeries::label);
  if (series == plot->series.end())
    series = plot->series.insert(series, PlotSeries{.label = label, .x = {}, .y = {}});
  series->x.push_back(x);
  series->y.push_back(y);
}

Table TransitionTable(const ClipSet& set, const std::vector<Method>& methods,
                      const std::vector<LengthFigures>& lengths) {
  Table table;
  table.name = "transitions_" + set.name;
  table.title = "Transitions between real poses, " + set.name;
  table.note = std::to_string(set.clips.size()) + " clips;";
  table.label_headings = {"frames", "method"};
  table.columns = {{"L2P cm", 2},
                   {"L2P / interpolation's", 2},
                   {"L2Q", 3},
                   {"NPSS", 3},
                   {"FID_k", 1},
                   {"FID_g", 1},
                   {"Div_k", 1},
                   {"Div_g", 1},
                   {"PFC", 2},
                   {"skating", 2},
                   {"acc. p95 m/s²", 0},
                   {"acc. max m/s²", 0},
                   {"jerk median m/s³", 0},
                   {"speed median m/s", 2}};
  Plot plot = RatioPlot("L2P over interpolation's, " + set.name);
  for (const LengthFigures& length : lengths) {
    table.note += " " + std::to_string(length.windows.size()) + " windows of " +
                  std::to_string(length.frames) + " frames;";
    if (length.windows.empty()) continue;
    const RealFeatures real = GatherRealFeatures(set, length.frames);
    for (const Method& method : methods) {
      table.rows.push_back(MethodRow(method.name, length, real));
      if (method.kind != Method::Kind::kReal)
        AddPoint(&plot, method.name, length.frames, table.rows.back().cells[1].value);
    }
  }
  table.note.back() = '.';
  table.plot = plot;
  return table;
}

Table KeyTable(const ClipSet& set, const std::vector<Method>& methods,
               const std::vector<LengthFigures>& lengths) {
  Table table;
  table.name = "keys_" + set.name;
  table.title = "How keys are met, " + set.name;
  table.label_headings = {"frames", "method"};
  table.columns = {{"raw KPD cm²", 3},  {"raw error mean cm", 2}, {"median cm", 2},
                   {"worst cm", 2},     {"final KPD cm²", 5},     {"final error worst mm", 4},
                   {"worst degrees", 5}};
  double worst = 0;
  for (const LengthFigures& length : lengths) {
    for (const Method& method : methods) {
      if (method.kind != Method::Kind::kEngine || !method.keys || length.windows.empty()) continue;
      const Figures& figures = length.methods.at(method.name);
      std::vector<float> raw;
      for (size_t i = 0; i < figures.size(); ++i) {
        raw.push_back(static_cast<float>(100 * figures[i].raw_key_m));
        if (method.name != kServed || figures[i].raw_key_m <= worst) continue;
        worst = figures[i].raw_key_m;
        table.note =
            "Raw: without arrival and foot lock; error: of the worst joint. The model's "
            "worst raw key: " +
            set.clips[length.windows[i].clip].name + ", frame " +
            std::to_string(length.windows[i].start) + " on.";
      }
      table.rows.push_back({{std::to_string(length.frames), method.name},
                            {Mean(figures, &WindowFigures::raw_key_distance, 1e4),
                             Mean(figures, &WindowFigures::raw_key_m, 100),
                             Cell{Percentile(raw, 0.5), {}}, Cell{Percentile(raw, 1), {}},
                             Cell{Mean(figures, &WindowFigures::key_distance, 1e4).value, {}},
                             Cell{1000 * Largest(figures, &WindowFigures::final_key_m), {}},
                             Cell{Largest(figures, &WindowFigures::final_key_deg), {}}}});
    }
  }
  return table;
}

// One column a length.
Table RatioTable(const std::vector<LengthFigures>& lengths, const std::string& heading) {
  Table table;
  table.label_headings = {heading};
  for (const LengthFigures& length : lengths)
    table.columns.push_back({std::to_string(length.frames) + " frames", 2});
  return table;
}

Table GenreTable(const ClipSet& set, const std::vector<LengthFigures>& lengths) {
  Table table = RatioTable(lengths, "genre");
  table.name = "genres_" + set.name;
  table.title = "L2P of the model over interpolation's, by genre, " + set.name;
  table.note = "Intervals over clips: none where a genre has but one.";
  Plot plot = RatioPlot(table.title);
  std::vector<std::string> genres = Genres(set);
  if (genres.size() == 1) genres.clear();
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
  table.plot = plot;
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

}  // namespace

std::vector<Table> EvaluateTransitions(const ClipSet& set, const std::vector<Method>& methods,
                                       const EvalOptions& options, ProgressBar* progress) {
  const Method& served = Served(methods);
  std::vector<LengthFigures> lengths;
  for (const int frames : options.lengths) {
    const TransitionJudge judge(set, served.engine->model(), frames, options.windows_per_clip,
                                progress);
    LengthFigures length;
    length.frames = frames;
    length.windows = judge.windows();
    length.line = judge.Run({"interpolation", Method::Kind::kInterpolation}, options.temperature);
    for (const Method& method : methods) {
      Figures figures = judge.Run(method, options.temperature);
      if (method.kind == Method::Kind::kEngine && method.keys)
        judge.AddRawKeys(method, options.temperature, &figures);
      length.methods[method.name] = std::move(figures);
    }
    for (int sample = 0; sample < options.best_of; ++sample) {
      const Figures figures = judge.Run(served, 1.0F, static_cast<uint32_t>(sample));
      if (sample == 0) length.hot = length.best = figures;
      for (size_t i = 0; i < figures.size(); ++i) {
        if (figures[i].l2p < length.best[i].l2p) length.best[i] = figures[i];
      }
    }
    lengths.push_back(std::move(length));
  }
  std::vector<Table> tables = {TransitionTable(set, methods, lengths),
                               KeyTable(set, methods, lengths), GenreTable(set, lengths)};
  if (options.best_of > 0) tables.push_back(SampleTable(set, lengths, options));
  return tables;
}

int64_t CountTransitionFrames(const ClipSet& set, const std::vector<Method>& methods,
                              const EvalOptions& options) {
  int64_t passes = options.best_of;
  for (const Method& method : methods) {
    if (method.kind == Method::Kind::kEngine) passes += method.keys ? 2 : 1;
  }
  int64_t frames = 0;
  const int history = Served(methods).engine->model().history_frames;
  for (const int length : options.lengths) {
    frames += length * static_cast<int64_t>(
                           ChooseWindows(set, history, length, options.windows_per_clip).size());
  }
  return frames * passes;
}

}  // namespace choreo
