#include "model/evaluation/long_tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/evaluation/beat_table.h"
#include "model/evaluation/long_figures.h"
#include "model/evaluation/long_plans.h"
#include "model/evaluation/pose_distance.h"

namespace choreo {
namespace {

constexpr int kInfluenceDances = 8;
constexpr int kInfluenceFrames = 600;

bool HasMusic(const ClipSet& set) {
  return std::ranges::any_of(set.clips, [](const auto& clip) { return clip.audio.cols() > 0; });
}

std::vector<KeyTimes> KindsFor(const ClipSet& set) {
  std::vector<KeyTimes> kinds = {KeyTimes::kNone, KeyTimes::kEachTwoSeconds};
  if (HasMusic(set)) kinds.insert(kinds.end(), {KeyTimes::kEqual, KeyTimes::kOnBeats});
  return kinds;
}

std::vector<Chain> Dance(StepEngine& engine, const std::vector<LongPlan>& plans, const ClipSet& set,
                         ProgressBar* progress) {
  std::vector<ChainPlan> chains;
  for (const LongPlan& plan : plans) chains.push_back(plan.chain);
  return DanceChains(engine, chains, [&](int frames) {
    if (progress != nullptr) progress->Advance(frames, set.name + ", long dances");
  });
}

std::vector<int> KeyFramesOf(const ChainPlan& plan) {
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
  std::vector<float> key_accelerations;
  for (const LongFigures& dance : dances) {
    reach = std::max(reach, dance.reach_m);
    lowest = std::min(lowest, dance.lowest_m);
    highest = std::max(highest, dance.highest_m);
    backwards += dance.bent_backwards / static_cast<double>(dances.size());
    skating += dance.skate_ratio / static_cast<double>(dances.size());
    within += real.JointsWithin(dance) / static_cast<double>(dances.size());
    key_accelerations.insert(key_accelerations.end(), dance.key_accelerations.begin(),
                             dance.key_accelerations.end());
  }
  const bool keys = !key_accelerations.empty();
  const auto above = static_cast<double>(std::ranges::count_if(
      key_accelerations, [&](float value) { return value > real.p95_acceleration; }));
  return {
      {name},
      {Cell{static_cast<double>(dances.size()), {}},
       median([](const LongFigures& dance) { return dance.median_speed; }),
       median([](const LongFigures& dance) { return dance.late_speed; }),
       share([&](const LongFigures& dance) { return real.Frozen(dance); }),
       share([&](const LongFigures& dance) { return real.Exploded(dance); }),
       median([](const LongFigures& dance) { return dance.reach_m; }), Cell{reach, {}},
       Cell{lowest, {}}, Cell{highest, {}}, Cell{100 * backwards, {}}, Cell{100 * within, {}},
       Cell{skating, {}}, median([](const LongFigures& dance) { return dance.p95_acceleration; }),
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

Table LongHeadings(const ClipSet& set) {
  Table table;
  table.name = "long_" + set.name;
  table.title = "Long dances, " + set.name;
  table.note =
      "Keys are poses of the clips. Frozen: the last fifth is slower than a quarter of real "
      "motion's median; exploded: a frame's mean joint speed is above all of real motion's. "
      "Heights are the extremes of all dances; a joint is at real speed if its median lies between "
      "the 5th and 95th percentile of real motion's; real motion's \"keys\" are its frames each "
      "2 s.";
  table.label_headings = {"dance"};
  table.columns = {{"dances", 0},
                   {"speed median m/s", 2},
                   {"last fifth m/s", 2},
                   {"frozen %", 0},
                   {"exploded %", 0},
                   {"reach median m", 1},
                   {"reach max m", 1},
                   {"root lowest m", 2},
                   {"root highest m", 2},
                   {"hinges backwards %", 3},
                   {"joints at real speed %", 0},
                   {"skating", 2},
                   {"acc. p95 m/s²", 0},
                   {"acc. at keys median m/s²", 0},
                   {"keys above real p95 %", 0},
                   {"worst key mm", 4}};
  return table;
}

// Mean distance of the same frames of two dances, cm.
double Distance(const Skeleton& skeleton, const Chain& a, const Chain& b) {
  return 100 * L2P(TrackJoints(skeleton, a.poses), TrackJoints(skeleton, b.poses));
}

// The next clip's song in place of its own, again and again. The first row is of the history's
// first frame, beats count from the dance's.
void HearNextSong(const ClipSet& set, int history, LongPlan* plan) {
  const size_t other = (plan->clip + 1) % set.clips.size();
  const auto& song = set.clips[other].audio;
  if (song.cols() == 0) return;
  ChainPlan& chain = plan->chain;
  for (Eigen::Index t = 0; t < chain.audio.cols(); ++t)
    chain.audio.col(t) = song.col(t % song.cols());
  const auto length = static_cast<int>(song.cols());
  const std::vector<double> beats = set.BeatsBetween(other, 0, length);
  chain.beats.clear();
  for (int from = -history; from < chain.frames; from += length) {
    for (const double beat : beats)
      if (from + beat >= 0 && from + beat < chain.frames) chain.beats.push_back(from + beat);
  }
}

Table InfluenceTable(const ClipSet& set, StepEngine& engine, const EvalOptions& options,
                     ProgressBar* progress) {
  Table table;
  table.name = "influence_" + set.name;
  table.title = "What changes a dance, " + set.name;
  table.note =
      "Mean distance of all joints between two dances from the same history, that differ in one "
      "thing, over their first 20 s at most; cm.";
  table.label_headings = {"dance"};
  table.columns = {{"another seed", 2}, {"another seed, T = 1", 2}};
  const bool music = HasMusic(set);
  if (music) table.columns.insert(table.columns.end(), {{"another song", 2}, {"no song", 2}});
  EvalOptions shorter = options;
  shorter.long_frames = std::min(options.long_frames, kInfluenceFrames);
  for (const KeyTimes times : {KeyTimes::kNone, KeyTimes::kEachTwoSeconds}) {
    const std::vector<LongPlan> plans =
        PlanLongDances(engine.model(), set, times, kInfluenceDances, shorter);
    if (plans.empty()) continue;
    const auto dance = [&](auto change) {
      std::vector<LongPlan> changed = plans;
      for (LongPlan& plan : changed) change(plan);
      return Dance(engine, changed, set, progress);
    };
    const auto distance = [&](const std::vector<Chain>& a, const std::vector<Chain>& b) {
      double sum = 0;
      for (size_t i = 0; i < a.size(); ++i) sum += Distance(engine.model().skeleton, a[i], b[i]);
      return Cell{sum / static_cast<double>(a.size()), {}};
    };
    const auto other_seed = [](LongPlan& plan) { plan.chain.seed += 1000; };
    const std::vector<Chain> as_is = dance([](LongPlan&) {});
    const std::vector<Chain> hot = dance([](LongPlan& plan) { plan.chain.temperature = 1; });
    const std::vector<Chain> hot_seed = dance([&](LongPlan& plan) {
      plan.chain.temperature = 1;
      other_seed(plan);
    });
    TableRow row{{NameOf(times)}, {distance(as_is, dance(other_seed)), distance(hot, hot_seed)}};
    if (music) {
      row.cells.push_back(distance(as_is, dance([&](LongPlan& plan) {
                                     HearNextSong(set, engine.model().history_frames, &plan);
                                   })));
      row.cells.push_back(distance(as_is, dance([](LongPlan& plan) {
                                     plan.chain.audio.resize(0, 0);
                                     plan.chain.beats.clear();
                                   })));
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

std::vector<Table> EvaluateLongDances(const ClipSet& set, StepEngine& engine,
                                      const EvalOptions& options, ProgressBar* progress) {
  if (options.long_seeds == 0) return {};
  const ModelInfo& model = engine.model();
  std::vector<LongFigures> real;
  std::vector<JointTrack> tracks;
  for (const PreparedClip& clip : set.clips) {
    std::vector<int> frames;
    for (int f = 59; f < static_cast<int>(clip.motion.frames.size()); f += 60) frames.push_back(f);
    real.push_back(MeasureLong(model.skeleton, model.fps, clip.motion.frames, frames));
    tracks.push_back(TrackJoints(model.skeleton, clip.motion.frames));
  }
  const RealRange range = RangeOf(real, tracks, model.fps);
  Table table = LongHeadings(set);
  table.rows.push_back(LongRow("real motion", real, range, 0));
  table.plot = Plot{.title = "Mean joint speed through long dances, " + set.name,
                    .x_label = "seconds",
                    .y_label = "m/s",
                    .series = {SpeedCurve("real motion", real, model.fps, options.long_frames)}};
  BeatTable beat_table(set);
  for (const KeyTimes times : KindsFor(set)) {
    const std::vector<LongPlan> plans =
        PlanLongDances(model, set, times, options.long_seeds, options);
    const std::vector<Chain> chains = Dance(engine, plans, set, progress);
    std::vector<LongFigures> dances;
    double worst_key = 0;
    for (size_t i = 0; i < chains.size(); ++i) {
      for (const auto& [frame, error] : chains[i].keys) worst_key = std::max(worst_key, error);
      if (times == KeyTimes::kNone || times == KeyTimes::kEachTwoSeconds) {
        dances.push_back(
            MeasureLong(model.skeleton, model.fps, chains[i].poses, KeyFramesOf(plans[i].chain)));
      }
      beat_table.Add(NameOf(times), plans[i].clip, plans[i].start,
                     MeanSpeeds(TrackJoints(model.skeleton, chains[i].poses), model.fps));
    }
    if (dances.empty()) continue;
    table.rows.push_back(LongRow(NameOf(times), dances, range, worst_key));
    table.plot->series.push_back(SpeedCurve(NameOf(times), dances, model.fps, options.long_frames));
  }
  std::vector<Table> tables = {table};
  if (HasMusic(set)) {
    for (size_t clip = 0; clip < set.clips.size(); ++clip)
      beat_table.Add("real", clip, 0, real[clip].speeds);
    tables.push_back(beat_table.Finish());
  }
  tables.push_back(InfluenceTable(set, engine, options, progress));
  return tables;
}

int64_t CountLongFrames(const ClipSet& set, const ModelInfo& model, const EvalOptions& options) {
  if (options.long_seeds == 0) return 0;
  int64_t frames = 0;
  const auto add = [&](int count, const EvalOptions& like, int64_t times) {
    for (const LongPlan& plan : PlanLongDances(model, set, KeyTimes::kNone, count, like))
      frames += times * plan.chain.frames;
  };
  add(options.long_seeds, options, static_cast<int64_t>(KindsFor(set).size()));
  EvalOptions shorter = options;
  shorter.long_frames = std::min(options.long_frames, kInfluenceFrames);
  add(kInfluenceDances, shorter, HasMusic(set) ? 12 : 8);
  return frames;
}

}  // namespace choreo
