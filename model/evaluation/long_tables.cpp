#include <algorithm>
#include <cmath>

#include "model/evaluation/beat_table.h"
#include "model/evaluation/evaluation.h"
#include "model/evaluation/long_figures.h"
#include "model/evaluation/long_plans.h"

namespace choreo {
namespace {

std::vector<KeyTimes> KindsFor(const ClipSet& set) {
  std::vector<KeyTimes> kinds = {KeyTimes::kNone, KeyTimes::kEachTwoSeconds};
  if (set.HasMusic()) kinds.insert(kinds.end(), {KeyTimes::kEqual, KeyTimes::kOnBeats});
  return kinds;
}

std::vector<int> KeyFramesOf(const LongPlan& plan) {
  std::vector<int> frames;
  for (const auto& [frame, pose] : plan.keys) frames.push_back(frame);
  return frames;
}

TableRow LongRow(const std::string& name, const std::vector<LongFigures>& dances,
                 const RealRange& real, double worst_key_m) {
  const auto median = [&](auto figure) {
    std::vector<float> values;
    for (const LongFigures& dance : dances) values.push_back(static_cast<float>(figure(dance)));
    return Cell{Percentile(values, 0.5), {}};
  };
  const auto share = [&](auto is) {
    return Cell{100.0 * static_cast<double>(std::ranges::count_if(dances, is)) /
                    static_cast<double>(dances.size()),
                {}};
  };
  double reach = 0, lowest = INFINITY, highest = 0, backwards = 0, skating = 0, within = 0;
  double minutes = 0, knee_snaps = 0, elbow_snaps = 0;
  std::vector<float> key_accelerations;
  for (const LongFigures& dance : dances) {
    reach = std::max(reach, dance.reach_m);
    lowest = std::min(lowest, dance.lowest_m);
    highest = std::max(highest, dance.highest_m);
    backwards += dance.bent_backwards / static_cast<double>(dances.size());
    minutes += dance.seconds / 60;
    knee_snaps += dance.snaps.knees;
    elbow_snaps += dance.snaps.elbows;
    skating += dance.skate_ratio / static_cast<double>(dances.size());
    within += real.JointsWithin(dance) / static_cast<double>(dances.size());
    key_accelerations.insert(key_accelerations.end(), dance.key_accelerations.begin(),
                             dance.key_accelerations.end());
  }
  const bool keys = !key_accelerations.empty();
  const auto above = static_cast<double>(std::ranges::count_if(
      key_accelerations, [&](float value) { return value > real.p95_acceleration; }));
  return {{name},
          {Cell{static_cast<double>(dances.size()), {}},
           median([](const LongFigures& dance) { return dance.seconds; }),
           median([](const LongFigures& dance) { return dance.median_speed; }),
           median([](const LongFigures& dance) { return dance.late_speed; }),
           median([](const LongFigures& dance) { return dance.stillest; }),
           share([&](const LongFigures& dance) { return real.Frozen(dance); }),
           share([&](const LongFigures& dance) { return real.Exploded(dance); }),
           share([&](const LongFigures& dance) { return real.Drifted(dance); }),
           median([](const LongFigures& dance) { return dance.away_m_per_min; }),
           median([](const LongFigures& dance) { return std::abs(dance.rise_m); }),
           median([](const LongFigures& dance) { return dance.pace_change; }),
           median([](const LongFigures& dance) { return dance.reach_m; }),
           Cell{reach, {}},
           Cell{lowest, {}},
           Cell{highest, {}},
           Cell{100 * backwards, {}},
           Cell{knee_snaps / minutes, {}},
           Cell{elbow_snaps / minutes, {}},
           Cell{100 * within, {}},
           Cell{skating, {}},
           median([](const LongFigures& dance) { return dance.p95_acceleration; }),
           Cell{keys ? Percentile(key_accelerations, 0.5) : NAN, {}},
           Cell{keys ? 100 * above / static_cast<double>(key_accelerations.size()) : NAN, {}},
           Cell{keys ? 1000 * worst_key_m : NAN, {}}}};
}

// The mean joint speed second by second, mean over dances that last as long.
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
    curve.x.push_back((static_cast<double>(at) + 0.5 * static_cast<double>(step)) / fps);
    curve.y.push_back(sum / static_cast<double>(count));
  }
  return curve;
}

Table LongHeadings(const Evaluation& evaluation) {
  Table table = evaluation.NewTable("long", "Long dances");
  table.note =
      "Keys are poses of the clips, whose songs end a dance. Frozen: the last fifth is slower than "
      "a quarter of real motion's median; who stands before that and moves again shows in the "
      "slowest fifth anywhere (stillest) alone; exploded: a frame's mean joint speed is above all "
      "of real motion's; "
      "drifted: the root goes away from its start (slope of a line through its distances), or is "
      "higher or lower in the last 10 s than in the first, or the mean joint speed is another "
      "there, "
      "by more than in any real clip, and than 3 m/min, 15 cm, a factor of 2. Medians of these "
      "three; heights are the extremes of all dances; a limb snaps in a step that bends or "
      "stretches "
      "it by more than 240 degrees a second (8 a frame) from or to less than 5 degrees of flexion; "
      "a joint is at real speed if its median lies "
      "between the 5th and 95th percentile of real motion's; real motion's \"keys\" are its frames "
      "each 2 s; the real motion of the keys is what lies between them, which a clip that is "
      "shorter than the dance has forwards, backwards, forwards.";
  table.label_headings = {"dance"};
  table.columns = {{"dances", 0},
                   {"seconds median", 0},
                   {"speed median m/s", 2},
                   {"last fifth m/s", 2},
                   {"stillest fifth m/s", 2},
                   {"frozen %", 0},
                   {"exploded %", 0},
                   {"drifted %", 0},
                   {"away m/min", 2},
                   {"rise m", 3},
                   {"pace, end / start", 2},
                   {"reach median m", 1},
                   {"reach max m", 1},
                   {"root lowest m", 2},
                   {"root highest m", 2},
                   {"hinges backwards %", 3},
                   {"knee snaps a minute", 1},
                   {"elbow snaps a minute", 1},
                   {"joints at real speed %", 0},
                   {"skating", 2},
                   {"acc. p95 m/s²", 0},
                   {"acc. at keys median m/s²", 0},
                   {"keys above real p95 %", 0},
                   {"worst key mm", 4}};
  return table;
}

}  // namespace

std::vector<Table> EvaluateLongDances(const Evaluation& evaluation) {
  const EvalOptions& options = evaluation.options;
  if (options.long_seeds == 0) return {};
  const ClipSet& set = evaluation.set;
  const ModelInfo& model = evaluation.model();
  const RealDances real = MeasureReal(set, model);
  Table table = LongHeadings(evaluation);
  table.rows.push_back(LongRow("real motion", real.clips, real.range, 0));
  table.plot =
      Plot{.title = "Mean joint speed through long dances, " + set.name,
           .x_label = "seconds",
           .y_label = "m/s",
           .series = {SpeedCurve("real motion", real.clips, model.fps, options.long_frames)}};
  BeatTable beat_table(set);
  for (const KeyTimes times : KindsFor(set)) {
    const std::vector<LongPlan> plans =
        PlanLongDances(model, set, times, options.long_seeds, options);
    const std::vector<LongDance> chains =
        evaluation.runner.DanceLong(*evaluation.judged().engine, plans);
    const bool keyed = times == KeyTimes::kEachTwoSeconds;
    std::vector<LongFigures> dances, beside;
    double worst_key = 0;
    for (size_t i = 0; i < chains.size(); ++i) {
      const auto measure = [&](const std::vector<Pose>& poses) {
        return MeasureLong(model.skeleton, model.fps, poses, KeyFramesOf(plans[i]));
      };
      for (const auto& [frame, error] : chains[i].keys) worst_key = std::max(worst_key, error);
      if (keyed || times == KeyTimes::kNone) dances.push_back(measure(chains[i].poses));
      if (keyed) beside.push_back(measure(RealMotionBeside(plans[i], set)));
      beat_table.Add(NameOf(times), plans[i].clip, plans[i].start,
                     MeanSpeeds(TrackJoints(model.skeleton, chains[i].poses), model.fps));
    }
    if (dances.empty()) continue;
    table.rows.push_back(LongRow(NameOf(times), dances, real.range, worst_key));
    if (keyed) table.rows.push_back(LongRow("real motion of these keys", beside, real.range, 0));
    table.plot->series.push_back(SpeedCurve(NameOf(times), dances, model.fps, options.long_frames));
  }
  std::vector<Table> tables = {table};
  if (set.HasMusic()) {
    for (size_t clip = 0; clip < set.clips.size(); ++clip)
      beat_table.Add("real", clip, 0, real.clips[clip].speeds);
    tables.push_back(beat_table.Finish());
  }
  return tables;
}

}  // namespace choreo
