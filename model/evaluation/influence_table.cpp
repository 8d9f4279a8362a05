#include "model/evaluation/influence_table.h"

#include <algorithm>

#include "model/evaluation/long_plans.h"
#include "model/metrics/pose_distance.h"

namespace choreo {
namespace {

constexpr int kDances = 8;
constexpr int kFrames = 600;  // of each, at most

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

}  // namespace

Table EvaluateInfluence(const ClipSet& set, StepEngine& engine, const EvalOptions& options,
                        ProgressBar* progress) {
  Table table;
  table.name = "influence_" + set.name;
  table.title = "What changes a dance, " + set.name;
  table.note =
      "Mean distance of all joints between two dances from the same history, that differ in one "
      "thing, over their first 20 s at most; cm.";
  table.label_headings = {"dance"};
  table.columns = {{"another seed", 2}, {"another seed, T = 1", 2}};
  const bool music = set.HasMusic();
  if (music) table.columns.insert(table.columns.end(), {{"another song", 2}, {"no song", 2}});
  const EvalOptions shorter = Shorter(options, kFrames);
  for (const KeyTimes times : {KeyTimes::kNone, KeyTimes::kEachTwoSeconds}) {
    const std::vector<LongPlan> plans =
        PlanLongDances(engine.model(), set, times, kDances, shorter);
    if (plans.empty()) continue;
    const auto dance = [&](auto change) {
      std::vector<LongPlan> changed = plans;
      for (LongPlan& plan : changed) change(plan);
      return DanceLong(engine, changed, set, progress);
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

int64_t CountInfluenceFrames(const ClipSet& set, const ModelInfo& model,
                             const EvalOptions& options) {
  int64_t frames = 0;
  for (const LongPlan& plan :
       PlanLongDances(model, set, KeyTimes::kNone, kDances, Shorter(options, kFrames)))
    frames += plan.chain.frames * (set.HasMusic() ? 12 : 8);
  return frames;
}

}  // namespace choreo
