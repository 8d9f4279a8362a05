#include <algorithm>
#include <map>

#include "model/evaluation/transition_judge.h"

namespace choreo {
namespace {

// All that was measured at one length.
struct LengthFigures {
  int frames = 0;
  std::vector<EvalWindow> windows;
  std::map<std::string, Figures> methods;
  Figures line;  // interpolation, whether or not it has a row
};

Cell RatioToLine(const Figures& figures, const Figures& line) {
  return Ratio(FiguresOf(figures, &WindowFigures::l2p), FiguresOf(line, &WindowFigures::l2p));
}

void AddPoint(Plot* plot, const std::string& label, double x, double y) {
  auto series = std::ranges::find(plot->series, label, &PlotSeries::label);
  if (series == plot->series.end())
    series = plot->series.insert(series, PlotSeries{.label = label, .x = {}, .y = {}});
  series->x.push_back(x);
  series->y.push_back(y);
}

void AddMethod(const std::string& method, const LengthFigures& length, const RealFeatures& real,
               Table* table) {
  const Figures& figures = length.methods.at(method);
  Pace pace;
  for (const WindowFigures& window : figures) pace.Add(window.pace);
  const Cell npss = Ratio(FiguresOf(figures, &WindowFigures::npss_sum),
                          FiguresOf(figures, &WindowFigures::npss_weight));
  const FeatureFigures kinetic = CompareFeatures(real.kinetic, figures, &WindowFigures::kinetic);
  const FeatureFigures geometric =
      CompareFeatures(real.geometric, figures, &WindowFigures::geometric);
  const auto mean = [&](double WindowFigures::*figure) { return Mean(figures, figure).value; };
  table->Begin({std::to_string(length.frames), method});
  table->Put("L2P cm", 2, Mean(figures, &WindowFigures::l2p, 100));
  table->Put("L2P / interpolation's", 2, RatioToLine(figures, length.line));
  table->Put("L2Q", 3, mean(&WindowFigures::l2q));
  table->Put("NPSS", 3, npss.value);
  table->Put("FID_k", 1, kinetic.distance);
  table->Put("FID_g", 1, geometric.distance);
  table->Put("Div_k", 1, kinetic.diversity);
  table->Put("Div_g", 1, geometric.diversity);
  table->Put("PFC", 2, mean(&WindowFigures::pfc));
  table->Put("skating", 2, mean(&WindowFigures::skate_ratio));
  table->Put("acc. p95 m/s²", 0, mean(&WindowFigures::p95_acceleration));
  table->Put("acc. max m/s²", 0, Largest(figures, &WindowFigures::max_acceleration));
  table->Put("jerk median m/s³", 0, pace.median_jerk());
  table->Put("speed median m/s", 2, pace.median_speed());
}

Table TransitionTable(const Evaluation& evaluation, const std::vector<LengthFigures>& lengths) {
  const ClipSet& set = evaluation.set;
  Table table =
      evaluation.NewTable("transitions", "Transitions between real poses", {"frames", "method"});
  table.note = std::to_string(set.clips.size()) + " clips;";
  Plot plot{.title = "L2P over interpolation's, " + set.name,
            .x_label = "frames",
            .y_label = "L2P / interpolation's",
            .series = {},
            .from_zero = true};
  for (const LengthFigures& length : lengths) {
    table.note += " " + std::to_string(length.windows.size()) + " windows of " +
                  std::to_string(length.frames) + " frames;";
    if (length.windows.empty()) continue;
    const RealFeatures real = GatherRealFeatures(set, length.frames);
    for (const Method& method : evaluation.methods) {
      AddMethod(method.name, length, real, &table);
      // Without keys all are far away, and would press the others together.
      if (method.kind != Method::Kind::kReal && method.keys)
        AddPoint(&plot, method.name, length.frames, table.rows.back().cells[1].value);
    }
  }
  table.note.back() = '.';
  table.plot = plot;
  return table;
}

Table KeyTable(const Evaluation& evaluation, const std::vector<LengthFigures>& lengths) {
  Table table = evaluation.NewTable("keys", "How keys are met", {"frames", "method"});
  table.note =
      "Raw: without arrival and foot lock; error: of the worst joint. Keys are real motion's own "
      "poses; who is told of no key misses it.";
  std::string hardest;
  double worst = 0;
  for (const LengthFigures& length : lengths) {
    for (const Method& method : evaluation.methods) {
      if (length.windows.empty()) continue;
      const Figures& figures = length.methods.at(method.name);
      std::vector<float> raw;
      for (size_t i = 0; i < figures.size(); ++i) {
        raw.push_back(static_cast<float>(100 * figures[i].raw_key_m));
        if (&method != &evaluation.judged() || figures[i].raw_key_m <= worst) continue;
        worst = figures[i].raw_key_m;
        hardest = " The judged model's worst raw key: " +
                  evaluation.set.clips[length.windows[i].clip].name + ", frame " +
                  std::to_string(length.windows[i].start) + " on.";
      }
      table.Begin({std::to_string(length.frames), method.name});
      table.Put("raw KPD cm²", 3, Mean(figures, &WindowFigures::raw_key_distance, 1e4));
      table.Put("raw error mean cm", 2, Mean(figures, &WindowFigures::raw_key_m, 100));
      table.Put("median cm", 2, Percentile(raw, 0.5));
      table.Put("worst cm", 2, Percentile(raw, 1));
      table.Put("final KPD cm²", 5, Mean(figures, &WindowFigures::key_distance, 1e4).value);
      table.Put("final error worst mm", 4, 1000 * Largest(figures, &WindowFigures::final_key_m));
      table.Put("worst degrees", 5, Largest(figures, &WindowFigures::final_key_deg));
    }
  }
  table.note += hardest;
  return table;
}

Table NearnessTable(const Evaluation& evaluation, const Method& method) {
  const EvalOptions& options = evaluation.options;
  Table table =
      evaluation.NewTable("liveliness_l2p", "How near to the real way", {"frames"}, &method);
  table.note = "L2P over interpolation's, at temperature 0, as served, best of " +
               std::to_string(options.best_of) + " there.";
  for (const int frames : options.lengths) {
    const TransitionJudge judge(evaluation, method.engine->model(), frames);
    if (judge.windows().empty()) continue;
    const Figures line = judge.Interpolation();
    const Figures mean = judge.Run(method, 0);
    const Figures served = judge.Run(method, options.temperature);
    Figures best = served;
    for (int sample = 1; sample < options.best_of; ++sample) {
      const Figures another = judge.Run(method, options.temperature, static_cast<uint32_t>(sample));
      for (size_t i = 0; i < best.size(); ++i) best[i].l2p = std::min(best[i].l2p, another[i].l2p);
    }
    table.Begin({std::to_string(frames)});
    table.Put("interpolation cm", 2, Mean(line, &WindowFigures::l2p, 100));
    table.Put("T = 0 ÷ interpolation", 3, RatioToLine(mean, line));
    table.Put("served ÷ interpolation", 3, RatioToLine(served, line));
    table.Put("best ÷ interpolation", 3, RatioToLine(best, line));
    table.Put("best ÷ T = 0", 3, RatioToLine(best, mean));
  }
  return table;
}

}  // namespace

std::vector<Table> EvaluateTransitions(const Evaluation& evaluation) {
  std::vector<LengthFigures> lengths;
  for (const int frames : evaluation.options.lengths) {
    const TransitionJudge judge(evaluation, evaluation.model(), frames);
    LengthFigures length{frames, judge.windows(), {}, judge.Interpolation()};
    for (const Method& method : evaluation.methods) {
      Figures figures = judge.Run(method, evaluation.options.temperature);
      if (method.kind == Method::Kind::kEngine)
        judge.AddRawKeys(method, evaluation.options.temperature, &figures);
      length.methods[method.name] = std::move(figures);
    }
    lengths.push_back(std::move(length));
  }
  return {TransitionTable(evaluation, lengths), KeyTable(evaluation, lengths)};
}

std::vector<Table> EvaluateNearness(const Evaluation& evaluation) {
  std::vector<Table> tables;
  for (const Method& method : evaluation.methods)
    if (method.Judged()) tables.push_back(NearnessTable(evaluation, method));
  return tables;
}

}  // namespace choreo
