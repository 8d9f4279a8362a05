#include <algorithm>

#include "model/evaluation/judges/transition_judge.h"

namespace choreo {
namespace {

double Largest(const Figures& figures, double WindowFigures::*figure) {
  return (*std::ranges::max_element(figures, {}, figure)).*figure;
}

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

void AddCells(const Figures& figures, const Figures& line, const RealFeatures& real, Table* table) {
  Pace pace;
  for (const WindowFigures& window : figures) pace.Add(window.pace);
  const Cell npss = Ratio(FiguresOf(figures, [](const auto& one) { return one.npss.sum; }),
                          FiguresOf(figures, [](const auto& one) { return one.npss.weight; }));
  const FeatureFigures kinetic = CompareFeatures(real.kinetic, figures, &WindowFigures::kinetic);
  const FeatureFigures geometric =
      CompareFeatures(real.geometric, figures, &WindowFigures::geometric);
  const auto mean = [&](double WindowFigures::*figure) { return Mean(figures, figure).value; };
  table->Put("L2P cm", 2, Mean(figures, &WindowFigures::l2p, 100));
  table->Put("L2P / interpolation's", 2, RatioToLine(figures, line));
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

void AddKeyCells(const Figures& figures, Table* table) {
  std::vector<float> raw;
  for (const WindowFigures& window : figures)
    raw.push_back(static_cast<float>(100 * window.raw_key_m));
  table->Put("raw KPD cm²", 3, Mean(figures, &WindowFigures::raw_key_distance, 1e4));
  table->Put("raw error mean cm", 2, Mean(figures, &WindowFigures::raw_key_m, 100));
  table->Put("median cm", 2, Percentile(raw, 0.5));
  table->Put("worst cm", 2, Percentile(raw, 1));
  table->Put("final KPD cm²", 5, Mean(figures, &WindowFigures::key_distance, 1e4).value);
  table->Put("final error worst mm", 4, 1000 * Largest(figures, &WindowFigures::final_key_m));
  table->Put("worst degrees", 5, Largest(figures, &WindowFigures::final_key_deg));
}

Table NearnessTable(const Evaluation& evaluation, const Method& method) {
  const EvalOptions& options = evaluation.options;
  Table table =
      evaluation.NewTable("liveliness_l2p", "How near to the real way", {"frames"}, &method);
  table.note = "L2P over interpolation's, at temperature 0, as served, best of " +
               std::to_string(options.best_of) + " there.";
  for (const int frames : options.lengths) {
    const TransitionJudge judge(evaluation, method.sampler->model(), frames);
    if (judge.windows().empty()) continue;
    const Figures line = judge.Interpolation();
    const Figures mean = judge.Run(method, 0);
    const Figures served = judge.Run(method, options.temperature);
    Figures best = served;
    for (int sample = 1; sample < options.best_of; ++sample) {
      const Figures another = judge.Run(method, options.temperature, static_cast<uint32_t>(sample));
      for (size_t i = 0; i < best.size(); ++i) best[i].l2p = std::min(best[i].l2p, another[i].l2p);
    }
    table.AddRow({std::to_string(frames)});
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
  const ClipSet& set = evaluation.set;
  const float temperature = evaluation.options.temperature;
  Table table =
      evaluation.NewTable("transitions", "Transitions between real poses", {"frames", "method"});
  table.note = std::to_string(set.clips.size()) + " clips;";
  Plot plot{.title = "L2P over interpolation's, " + set.name,
            .x_label = "frames",
            .y_label = "L2P / interpolation's",
            .series = {},
            .from_zero = true};
  Table keys = evaluation.NewTable("keys", "How keys are met", {"frames", "method"});
  std::string hardest;
  double worst = 0;
  for (const int frames : evaluation.options.lengths) {
    const TransitionJudge judge(evaluation, evaluation.model(), frames);
    const std::vector<EvalWindow>& windows = judge.windows();
    table.note +=
        " " + std::to_string(windows.size()) + " windows of " + std::to_string(frames) + " frames;";
    if (windows.empty()) continue;
    const Figures line = judge.Interpolation();  // even if it has no row
    const RealFeatures real = GatherRealFeatures(set, frames);
    for (const Method& method : evaluation.methods) {
      Figures figures = judge.Run(method, temperature);
      if (method.kind == Method::Kind::kModel) judge.AddRawKeys(method, temperature, &figures);
      table.AddRow({std::to_string(frames), method.name});
      AddCells(figures, line, real, &table);
      keys.AddRow({std::to_string(frames), method.name});
      AddKeyCells(figures, &keys);
      // The distance of methods without keys is large and would compress the other curves.
      if (method.kind != Method::Kind::kReal && method.keys)
        AddPoint(&plot, method.name, frames, table.rows.back().cells[1].value);
      const double raw = Largest(figures, &WindowFigures::raw_key_m);
      if (&method != &evaluation.judged() || raw <= worst) continue;
      worst = raw;
      const auto at = std::ranges::find(figures, raw, &WindowFigures::raw_key_m) - figures.begin();
      hardest = " The judged model's worst raw key: " + set.clips[windows[at].clip].name +
                ", frame " + std::to_string(windows[at].start) + " on.";
    }
  }
  table.note.back() = '.';
  table.plot = plot;
  keys.note =
      "Raw: without arrival and footwork; error: of the worst joint. Keys are real motion's own "
      "poses; who is told of no key misses it." +
      hardest;
  return {table, keys};
}

std::vector<Table> EvaluateNearness(const Evaluation& evaluation) {
  std::vector<Table> tables;
  for (const Method& method : evaluation.methods)
    if (method.Judged()) tables.push_back(NearnessTable(evaluation, method));
  return tables;
}

}  // namespace choreo
