#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/long_figures.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/evaluation/tables/beat_table.h"

namespace choreo {
namespace {

struct LongKind {
  KeyTimes times;
  const char* name;
  bool to_music = false;
};

constexpr LongKind kLongKinds[] = {{KeyTimes::kNone, "no keys"},
                                   {KeyTimes::kEachTwoSeconds, "keys each 2 s"},
                                   {KeyTimes::kEqual, "keys each 100 frames", true},
                                   {KeyTimes::kOnBeats, "as many keys, on beats", true}};

void AddRow(const std::string& name, const std::vector<LongFigures>& dances, const RealRange& real,
            double worst_key_m, Table* table) {
  const auto count = static_cast<double>(dances.size());
  const auto median = [&](auto figure) {
    std::vector<float> values;
    for (const LongFigures& dance : dances)
      values.push_back(static_cast<float>(std::invoke(figure, dance)));
    return Percentile(std::move(values), 0.5);
  };
  const auto share = [&](auto is) { return 100.0 * std::ranges::count_if(dances, is) / count; };
  const auto sum = [&](auto figure) {
    double all = 0;
    for (const LongFigures& dance : dances) all += std::invoke(figure, dance);
    return all;
  };
  const double minutes = sum(&LongFigures::seconds) / 60;
  std::vector<float> jolts;
  for (const LongFigures& dance : dances)
    jolts.insert(jolts.end(), dance.key_accelerations.begin(), dance.key_accelerations.end());
  const auto of_keys = [&](auto figure) { return jolts.empty() ? NAN : figure(); };
  table->AddRow({name});
  table->Put("dances", 0, count);
  table->Put("seconds median", 0, median(&LongFigures::seconds));
  table->Put("speed median m/s", 2, median(&LongFigures::median_speed));
  table->Put("last fifth m/s", 2, median(&LongFigures::late_speed));
  table->Put("stillest fifth m/s", 2, median(&LongFigures::stillest));
  table->Put("frozen %", 0, share([&](const auto& dance) { return real.Frozen(dance); }));
  table->Put("exploded %", 0, share([&](const auto& dance) { return real.Exploded(dance); }));
  table->Put("drifted %", 0, share([&](const auto& dance) { return real.Drifted(dance); }));
  table->Put("away m/min", 2, median(&LongFigures::away_m_per_min));
  table->Put("rise m", 3, median([](const auto& dance) { return std::abs(dance.rise_m); }));
  table->Put("pace, end / start", 2, median(&LongFigures::pace_change));
  table->Put("reach median m", 1, median(&LongFigures::reach_m));
  table->Put("reach max m", 1, std::ranges::max(dances, {}, &LongFigures::reach_m).reach_m);
  table->Put("root lowest m", 2, std::ranges::min(dances, {}, &LongFigures::lowest_m).lowest_m);
  table->Put("root highest m", 2, std::ranges::max(dances, {}, &LongFigures::highest_m).highest_m);
  table->Put("hinges backwards %", 3, 100 * sum(&LongFigures::bent_backwards) / count);
  table->Put("knee snaps a minute", 1,
             sum([](const auto& dance) { return dance.snaps.knees; }) / minutes);
  table->Put("elbow snaps a minute", 1,
             sum([](const auto& dance) { return dance.snaps.elbows; }) / minutes);
  table->Put("joints at real speed %", 0,
             100 * sum([&](const auto& dance) { return real.JointsWithin(dance); }) / count);
  table->Put("skating", 2, sum(&LongFigures::skate_ratio) / count);
  table->Put("acc. p95 m/s²", 0, median(&LongFigures::p95_acceleration));
  table->Put("acc. at keys median m/s²", 0, of_keys([&] { return Percentile(jolts, 0.5); }));
  table->Put("keys above real p95 %", 0, of_keys([&] {
               const auto above = std::ranges::count_if(
                   jolts, [&](float jolt) { return jolt > real.p95_acceleration; });
               return 100.0 * above / jolts.size();
             }));
  table->Put("worst key mm", 4, of_keys([&] { return 1000 * worst_key_m; }));
}

// The mean joint speed second by second, averaged over dances of equal length.
PlotSeries SpeedCurve(const std::string& label, const std::vector<LongFigures>& dances, double fps,
                      int frames) {
  PlotSeries curve{.label = label, .x = {}, .y = {}};
  const auto step = static_cast<size_t>(std::lround(2 * fps));
  for (size_t at = 0; at + step < static_cast<size_t>(frames); at += step) {
    double sum = 0;
    size_t count = 0;
    for (const LongFigures& dance : dances) {
      if (dance.speeds.size() < at + step) continue;
      for (size_t i = at; i < at + step; ++i) sum += dance.speeds[i];
      count += step;
    }
    if (count == 0) break;
    curve.x.push_back((static_cast<double>(at) + 0.5 * step) / fps);
    curve.y.push_back(sum / count);
  }
  return curve;
}

constexpr char kLongNote[] =
    "Keys are poses of the clips, whose songs end a dance. Frozen: the last fifth is slower than a "
    "quarter of real motion's median; who stands before that and moves again shows in the slowest "
    "fifth anywhere (stillest) alone; exploded: a frame's mean joint speed is above all of real "
    "motion's; drifted: the root goes away from its start (slope of a line through its distances), "
    "or is higher or lower in the last 10 s than in the first, or the mean joint speed is another "
    "there, by more than in any real clip, and than 3 m/min, 15 cm, a factor of 2. Medians of "
    "these three; heights are the extremes of all dances; a limb snaps in a step that bends or "
    "stretches it by more than 240 degrees a second (8 a frame) from or to less than 5 degrees of "
    "flexion; a joint is at real speed if its median lies between the 5th and 95th percentile of "
    "real motion's; real motion's \"keys\" are its frames each 2 s; the real motion of the keys is "
    "what lies between them, which a clip that is shorter than the dance has forwards, backwards, "
    "forwards.";

}  // namespace

std::vector<Table> EvaluateLongDances(const Evaluation& evaluation) {
  const EvalOptions& options = evaluation.options;
  if (options.long_seeds == 0) return {};
  const ClipSet& set = evaluation.set;
  const ModelInfo& model = evaluation.model();
  const bool music =
      std::ranges::any_of(set.clips, [](const auto& clip) { return clip.audio.cols() > 0; });
  const RealDances real = MeasureReal(set, model);
  Table table = evaluation.NewTable("long", "Long dances", {"dance"});
  table.note = kLongNote;
  AddRow("real motion", real.clips, real.range, 0, &table);
  table.plot =
      Plot{.title = "Mean joint speed through long dances, " + set.name,
           .x_label = "seconds",
           .y_label = "m/s",
           .series = {SpeedCurve("real motion", real.clips, model.fps, options.long_frames)}};
  BeatTable beat_table(set);
  for (const LongKind& kind : kLongKinds) {
    if (kind.to_music && !music) continue;
    const std::vector<LongPlan> plans =
        PlanLongDances(model, set, kind.times, options.long_seeds, options);
    const std::vector<LongDance> chains =
        evaluation.runner.DanceLong(*evaluation.judged().sampler, plans);
    const bool keyed = kind.times == KeyTimes::kEachTwoSeconds;
    std::vector<LongFigures> dances, beside;
    double worst_key = 0;
    for (size_t i = 0; i < chains.size(); ++i) {
      std::vector<int> keys;
      for (const auto& [frame, pose] : plans[i].keys) keys.push_back(frame);
      const auto measure = [&](const std::vector<Pose>& poses) {
        return MeasureLong(model.skeleton, model.fps, poses, keys);
      };
      for (const auto& [frame, error] : chains[i].keys) worst_key = std::max(worst_key, error);
      if (!kind.to_music) dances.push_back(measure(chains[i].poses));
      if (keyed) beside.push_back(measure(RealMotionBeside(plans[i], set)));
      beat_table.Add(kind.name, plans[i].clip, plans[i].start,
                     MeanSpeeds(TrackJoints(model.skeleton, chains[i].poses), model.fps));
    }
    if (dances.empty()) continue;
    AddRow(kind.name, dances, real.range, worst_key, &table);
    if (keyed) AddRow("real motion of these keys", beside, real.range, 0, &table);
    table.plot->series.push_back(SpeedCurve(kind.name, dances, model.fps, options.long_frames));
  }
  std::vector<Table> tables = {table};
  if (music) {
    for (size_t clip = 0; clip < set.clips.size(); ++clip)
      beat_table.Add("real", clip, 0, real.clips[clip].speeds);
    tables.push_back(beat_table.Finish());
  }
  return tables;
}

}  // namespace choreo
