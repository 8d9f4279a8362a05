#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/core/rounded.h"
#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/long_figures.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/evaluation/judges/transition_judge.h"
#include "model/evaluation/tables/band_table.h"
#include "model/evaluation/tables/liveliness_figures.h"
#include "model/evaluation/tables/weight_table.h"
#include "model/metrics/contrast.h"
#include "model/metrics/critic.h"
#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics/canonical.h"

namespace choreo {
namespace {

constexpr int kSeeds = 3;
constexpr int kFrechetFrames = 60;
constexpr int kSparse = 240;                        // frames between few keys
constexpr double kMinRatio = 0.7, kMaxRatio = 1.4;  // relative to real motion's median speed

// The facts about music in a request.
struct Song {
  double bpm = 0;
  double phase = 0;
  bool shuffled = false;
};
// The first three vary the tempo, the next the phase, the next is a control; the last is for the
// range.
constexpr size_t kTimedSong = 1;  // the song whose jerk is in the table
constexpr Song kSongs[] = {{90, 0}, {110, 0}, {130, 0}, {110, 0.5}, {110, 0, true},
                           {60, 0}, {75, 0},  {150, 0}, {180, 0}};

// All dances through keys, and recorded ones for comparison.
struct KeyedDances {
  LivelinessDances real, locked;
  LivelinessDances sparse;  // few keys, seed 0
  std::vector<LivelinessDances> seeds = std::vector<LivelinessDances>(kSeeds);
  std::vector<LivelinessDances> songs = std::vector<LivelinessDances>(std::size(kSongs));  // seed 0
};

void Add(const std::string& figure, Cell real, Cell locked, Cell danced, Cell ratio, Table* table) {
  table->AddRow({figure});
  table->Put("real motion", 2, real);
  table->Put("real, footwork", 2, locked);
  table->Put("danced", 2, danced);
  table->Put("danced ÷ real", 2, ratio);
}
void AddReal(const std::string& figure, double real, Table* table) {
  Add(figure, real, {}, {}, {}, table);
}
void AddDanced(const std::string& figure, Cell danced, Table* table) {
  Add(figure, {}, {}, danced, {}, table);
}

KeyedDances DanceKeyed(const Evaluation& evaluation, const Method& method) {
  const ClipSet& set = evaluation.set;
  const ModelInfo& model = method.sampler->model();
  std::vector<LongPlan> plans = PlanKeyedDances(model, set, evaluation.options.temperature);
  for (LongPlan& plan : plans) plan.finished = method.finished;
  KeyedDances dances;
  for (const LongPlan& plan : plans) {
    dances.real.push_back(MeasureLiveliness(model, plan, RealMotionBeside(plan, set)));
    dances.locked.push_back(MeasureLiveliness(model, plan, RealThroughFootwork(model, plan, set)));
  }
  if (plans.empty()) return dances;
  std::vector<LongPlan> all;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    all.insert(all.end(), plans.begin(), plans.end());
    for (size_t i = all.size() - plans.size(); i < all.size(); ++i) all[i].seed = seed;
  }
  for (const Song& song : kSongs) {
    for (LongPlan plan : plans) {
      plan.beats = song.shuffled ? ShuffledBeats(song.bpm, plan.clip, model.fps, plan.frames)
                                 : RegularBeats(song.bpm, song.phase, model.fps, plan.frames);
      all.push_back(std::move(plan));
    }
  }
  for (LongPlan& plan : PlanKeyedDances(model, set, evaluation.options.temperature, kSparse)) {
    plan.finished = method.finished;
    all.push_back(std::move(plan));
  }
  const std::vector<LongDance> chains = evaluation.runner.DanceLong(*method.sampler, all);
  for (size_t i = 0; i < all.size(); ++i) {
    const size_t repeat = i / plans.size();
    LivelinessDances& of = repeat < kSeeds                       ? dances.seeds[repeat]
                           : repeat < kSeeds + std::size(kSongs) ? dances.songs[repeat - kSeeds]
                                                                 : dances.sparse;
    of.push_back(MeasureLiveliness(model, all[i], chains[i].poses));
  }
  return dances;
}

// Flattens seed after seed, repeating the real dances beside them.
LivelinessDances Flat(const std::vector<LivelinessDances>& seeds) {
  LivelinessDances all;
  for (const LivelinessDances& dances : seeds) all.insert(all.end(), dances.begin(), dances.end());
  return all;
}

void AddMovement(const KeyedDances& dances, Table* table) {
  const LivelinessDances danced = Flat(dances.seeds);
  const LivelinessDances real = Flat(std::vector<LivelinessDances>(kSeeds, dances.real));
  const auto add = [&](const std::string& name, double LivelinessFigures::*figure, double unit) {
    const auto mean = [&](const LivelinessDances& some) { return Mean(some, figure, unit); };
    Add(name, mean(dances.real), mean(dances.locked), mean(danced),
        Ratio(FiguresOf(danced, figure), FiguresOf(real, figure)), table);
  };
  add("median speed cm/s", &LivelinessFigures::median_speed, 100);
  Add("median speed, keys each 8 s cm/s", {}, {},
      Mean(dances.sparse, &LivelinessFigures::median_speed, 100),
      Ratio(FiguresOf(dances.sparse, &LivelinessFigures::median_speed),
            FiguresOf(dances.real, &LivelinessFigures::median_speed)),
      table);
  std::vector<ClipFigure> within;
  for (size_t i = 0; i < danced.size(); ++i) {
    const double ratio = danced[i].median_speed / real[i].median_speed;
    within.push_back({danced[i].clip, ratio >= kMinRatio && ratio <= kMaxRatio ? 100.0 : 0.0});
  }
  Add("dances at " + Rounded(kMinRatio) + " to " + Rounded(kMaxRatio) + " of it %", 100, {},
      Mean(within), {}, table);
  const auto path = [](const LivelinessFigures& one) { return one.limbs.path; };
  const auto chord = [](const LivelinessFigures& one) { return one.limbs.chord; };
  const auto wandering = [&](const LivelinessDances& some) {
    return Ratio(FiguresOf(some, path), FiguresOf(some, chord));
  };
  Add("limbs' path over chord m/m", wandering(dances.real), wandering(dances.locked),
      wandering(danced), Ratio(FiguresOf(danced, path), FiguresOf(real, path)), table);
  add("pelvis bounce above 1 Hz mm", &LivelinessFigures::bounce, 1000);
  add("jerk below 8 Hz m/s³", &LivelinessFigures::jerk, 1);
  add("jerk, unfiltered m/s³", &LivelinessFigures::raw_jerk, 1);
  // Shows whether timing to beats adds jerk.
  const Song& song = kSongs[kTimedSong];
  const LivelinessDances& timed = dances.songs[kTimedSong];
  Add("jerk below 8 Hz, " + std::to_string(std::lround(song.bpm)) + " bpm m/s³", {}, {},
      Mean(timed, &LivelinessFigures::jerk, 1),
      Ratio(FiguresOf(timed, &LivelinessFigures::jerk),
            FiguresOf(dances.real, &LivelinessFigures::jerk)),
      table);
  add("skating %", &LivelinessFigures::skate_ratio, 100);
  add("knee snaps a minute", &LivelinessFigures::knee_snaps, 1);
  add("elbow snaps a minute", &LivelinessFigures::elbow_snaps, 1);
  add("arms inside the trunk %", &LivelinessFigures::arms_inside, 100);
  add("kinematic beats a minute", &LivelinessFigures::kinematic_beats, 1);
}

// The mean distance of all joints between the same frames of two dances of each plan, cm.
std::vector<ClipFigure> DistancesCm(const LivelinessDances& a, const LivelinessDances& b) {
  std::vector<ClipFigure> figures;
  for (size_t i = 0; i < a.size(); ++i)
    figures.push_back({a[i].clip, 100 * L2P(a[i].track, b[i].track)});
  return figures;
}

void AddDifferences(const KeyedDances& dances, Table* table) {
  std::vector<ClipFigure> seeds;
  for (size_t a = 0; a < kSeeds; ++a) {
    for (size_t b = a + 1; b < kSeeds; ++b)
      std::ranges::copy(DistancesCm(dances.seeds[a], dances.seeds[b]), std::back_inserter(seeds));
  }
  const std::vector<LivelinessDances>& songs = dances.songs;
  AddDanced("seeds differ cm", Mean(seeds), table);
  AddDanced("songs differ, 90 and 130 bpm cm", Mean(DistancesCm(songs[0], songs[2])), table);
  AddDanced("songs differ, half a beat apart cm", Mean(DistancesCm(songs[1], songs[3])), table);
}

void AddHits(const KeyedDances& dances, double fps, Table* table) {
  for (size_t i = 0; i < std::size(kSongs); ++i) {
    const Song& song = kSongs[i];
    const auto hits = [&](const LivelinessDances& some) {
      return HitsOverChance(some, song.bpm, song.phase, fps);
    };
    std::string name = "hits over chance, " + std::to_string(std::lround(song.bpm)) + " bpm";
    if (song.phase > 0) name += ", half a beat later";
    if (song.shuffled) name += ", told shuffled beats";
    Add(name + " points", hits(dances.real), hits(dances.locked), hits(dances.songs[i]), {}, table);
  }
}

void AddFrechet(const Evaluation& evaluation, const Method& method, Table* table) {
  const TransitionJudge judge(evaluation, method.sampler->model(), kFrechetFrames);
  if (judge.windows().empty()) return;
  const RealFeatures features = GatherRealFeatures(evaluation.set, kFrechetFrames);
  const Figures real = judge.Run({"real", Method::Kind::kReal}, 0);
  const Figures danced = judge.Run(method, evaluation.options.temperature);
  const auto add = [&](const std::string& name, const Eigen::MatrixXd& all, auto figure) {
    const double own = CompareFeatures(all, real, figure).distance;
    const double theirs = CompareFeatures(all, danced, figure).distance;
    Add(name, own, {}, theirs, theirs / own, table);
  };
  add("FID_k at 60 frames", features.kinetic, &WindowFigures::kinetic);
  add("FID_g at 60 frames", features.geometric, &WindowFigures::geometric);
  if (evaluation.training == nullptr) return;
  const RealFeatures others = GatherRealFeatures(*evaluation.training, kFrechetFrames);
  AddReal("FID_k, dancers of the training clips",
          CompareFeatures(features.kinetic, others.kinetic).distance, table);
  AddReal("FID_g, dancers of the training clips",
          CompareFeatures(features.geometric, others.geometric).distance, table);
}

void AddCritic(const Evaluation& evaluation, const KeyedDances& dances, double fps, Table* table) {
  const auto windows = [&](const LivelinessDances& some) {
    CriticWindows all;
    for (const LivelinessFigures& dance : some) all.Add(dance.track, fps, dance.clip);
    return all;
  };
  const CriticWindows locked = windows(dances.locked);
  Add("critic's area under the curve", {}, RealAgainstReal(locked),
      CriticArea(locked, windows(dances.seeds[0])), {}, table);
  if (evaluation.training == nullptr) return;
  CriticWindows others;
  for (size_t clip = 0; clip < evaluation.training->clips.size(); ++clip) {
    const PreparedClip& one = evaluation.training->clips[clip];
    others.Add(TrackJoints(one.skeleton, one.motion.frames), fps, clip);
  }
  AddReal("critic's area, dancers of the training clips", CriticArea(windows(dances.real), others),
          table);
}

// The dances without keys.
struct FreeDances {
  std::vector<LongFigures> whole;
  LivelinessDances lively;
};

FreeDances DanceFree(const Evaluation& evaluation, const Method& method) {
  const ModelInfo& model = method.sampler->model();
  const EvalOptions& options = evaluation.options;
  std::vector<LongPlan> plans =
      PlanLongDances(model, evaluation.set, KeyTimes::kNone, options.free_dances, options);
  for (LongPlan& plan : plans) plan.finished = method.finished;
  const std::vector<LongDance> chains = evaluation.runner.DanceLong(*method.sampler, plans);
  FreeDances free;
  for (size_t i = 0; i < plans.size(); ++i) {
    free.whole.push_back(MeasureLong(model.skeleton, model.fps, chains[i].poses, {}));
    free.lively.push_back(MeasureLiveliness(model, plans[i], chains[i].poses));
  }
  return free;
}

void AddFree(const Evaluation& evaluation, const ModelInfo& model, const FreeDances& free,
             Table* table) {
  const std::vector<LongFigures>& dances = free.whole;
  if (dances.empty()) return;
  const RealDances recorded = MeasureReal(evaluation.set, model);
  const RealRange& real = recorded.range;
  std::vector<float> speeds;
  for (const LongFigures& dance : dances) speeds.push_back(static_cast<float>(dance.median_speed));
  const auto share = [&](auto is) {
    return 100.0 * std::ranges::count_if(dances, is) / static_cast<double>(dances.size());
  };
  const double speed = Percentile(speeds, 0.5);
  Add("free: median speed cm/s", 100 * real.median_speed, {}, 100 * speed,
      speed / real.median_speed, table);
  const auto add_fastest = [&](const std::string& name, double rank) {
    const auto fastest = [rank](const std::vector<LongFigures>& some) {
      std::vector<float> all;
      for (const LongFigures& one : some)
        all.insert(all.end(), one.speeds.begin(), one.speeds.end());
      return Percentile(std::move(all), rank);
    };
    const double own = fastest(recorded.clips), theirs = fastest(dances);
    Add("free: " + name + " cm/s", 100 * own, {}, 100 * theirs, theirs / own, table);
  };
  add_fastest("one frame in 1,000 is faster than", 0.999);
  add_fastest("fastest frame", 1);
  AddDanced("free: frozen %", share([&](const auto& one) { return real.Frozen(one); }), table);
  AddDanced("free: exploded %", share([&](const auto& one) { return real.Exploded(one); }), table);
  AddDanced("free: drifted %", share([&](const auto& one) { return real.Drifted(one); }), table);
  // Recordings do not state where the audience is; dancers face it on average.
  double real_away = 0, away = 0;
  for (const PreparedClip& clip : evaluation.set.clips) {
    const std::vector<Pose>& poses = clip.motion.frames;
    real_away += FacesAway(poses, MeanFacing(poses)) / std::ssize(evaluation.set.clips);
  }
  for (const LivelinessFigures& dance : free.lively)
    away += dance.faces_away / std::ssize(free.lively);
  Add("free: faces away %", 100 * real_away, {}, 100 * away, away / real_away, table);
}

Table LivelinessTable(const Evaluation& evaluation, const Method& method, const KeyedDances& dances,
                      const FreeDances& free) {
  const double fps = method.sampler->model().fps;
  Table table = evaluation.NewTable("liveliness", "Liveliness", {"figure"}, &method);
  if (!dances.real.empty()) {
    AddMovement(dances, &table);
    AddDifferences(dances, &table);
    AddHits(dances, fps, &table);
    AddCritic(evaluation, dances, fps, &table);
  }
  AddFrechet(evaluation, method, &table);
  AddFree(evaluation, method.sampler->model(), free, &table);
  table.note = std::to_string(dances.real.size()) + " clips, " + std::to_string(kSeeds) +
               " seeds, the clips' own poses each 2 s as keys and nothing else of them; free: " +
               std::to_string(free.whole.size()) +
               " dances without keys. The critic is fair where it finds real motion against real "
               "between 0.45 and 0.55; dancers of the training clips are real ones, who dance "
               "something else.";
  return table;
}

}  // namespace

std::vector<Table> EvaluateLiveliness(const Evaluation& evaluation) {
  std::vector<Table> tables;
  for (const Method& method : evaluation.methods) {
    if (!method.Judged()) continue;
    const KeyedDances dances = DanceKeyed(evaluation, method);
    const FreeDances free = DanceFree(evaluation, method);
    tables.push_back(LivelinessTable(evaluation, method, dances, free));
    if (dances.real.empty()) continue;
    tables.push_back(BandTable(evaluation, method, dances.real, dances.seeds[0]));
    std::ranges::move(
        WeightTable(evaluation, method, dances.real, dances.locked, dances.seeds, free.lively),
        std::back_inserter(tables));
  }
  return tables;
}

}  // namespace choreo
