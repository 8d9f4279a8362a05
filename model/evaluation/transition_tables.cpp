#include "model/evaluation/transition_tables.h"

#include <algorithm>

#include "model/evaluation/ratio_tables.h"
#include "model/evaluation/transition_judge.h"

namespace choreo {
namespace {

const Method& Served(const std::vector<Method>& methods) {
  return *std::ranges::find(methods, kServed, &Method::name);
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
      // Without keys all are far away, and would press the others together.
      if (method.kind != Method::Kind::kReal && method.keys)
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
  table.note =
      "Raw: without arrival and foot lock; error: of the worst joint. Keys are real motion's own "
      "poses; who is told of no key misses it.";
  table.label_headings = {"frames", "method"};
  table.columns = {{"raw KPD cm²", 3},  {"raw error mean cm", 2}, {"median cm", 2},
                   {"worst cm", 2},     {"final KPD cm²", 5},     {"final error worst mm", 4},
                   {"worst degrees", 5}};
  std::string hardest;
  double worst = 0;
  for (const LengthFigures& length : lengths) {
    for (const Method& method : methods) {
      if (length.windows.empty()) continue;
      const Figures& figures = length.methods.at(method.name);
      std::vector<float> raw;
      for (size_t i = 0; i < figures.size(); ++i) {
        raw.push_back(static_cast<float>(100 * figures[i].raw_key_m));
        if (method.name != kServed || figures[i].raw_key_m <= worst) continue;
        worst = figures[i].raw_key_m;
        hardest = " The judged model's worst raw key: " + set.clips[length.windows[i].clip].name +
                  ", frame " + std::to_string(length.windows[i].start) + " on.";
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
  table.note += hardest;
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
      if (method.kind == Method::Kind::kEngine)
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
    if (method.kind == Method::Kind::kEngine) passes += 2;
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
