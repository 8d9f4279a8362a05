#include "model/evaluation/weight_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "model/metrics/balance.h"
#include "model/metrics/contrast.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kTurn = 60, kHalfTurn = 150, kWholeTurn = 270;  // degrees

// A dance and what it weighs.
struct Weighed {
  size_t clip = 0;
  WeightFigures weight;
  double half_turns = 0, whole_turns = 0;  // share of windows
  double at_rest = 0, spread = NAN;
};
using WeighedDances = std::vector<Weighed>;

double ShareBeyond(const std::vector<double>& turns, double degrees) {
  const auto wide = std::ranges::count_if(
      turns, [&](double turn) { return std::abs(turn) * kDegrees > degrees; });
  return static_cast<double>(wide) / static_cast<double>(std::max<size_t>(1, turns.size()));
}

Weighed Weigh(const Skeleton& skeleton, double fps, size_t clip, const JointTrack& track,
              const std::vector<double>& turns) {
  return {.clip = clip,
          .weight = MeasureWeight(skeleton, fps, track, DancedFloor(skeleton, track)),
          .half_turns = ShareBeyond(turns, kHalfTurn),
          .whole_turns = ShareBeyond(turns, kWholeTurn),
          .at_rest = HandsAtRest(skeleton, fps, track),
          .spread = PaceSpread(fps, track)};
}

// Mean of what is a number.
Cell MeanOfKnown(const WeighedDances& dances, const std::function<double(const Weighed&)>& figure,
                 double unit) {
  std::vector<ClipFigure> figures = FiguresOf(dances, figure, unit);
  std::erase_if(figures, [](const ClipFigure& one) { return std::isnan(one.value); });
  return Mean(figures);
}

// Of the windows in which the real dancer turns, those that turn the same way and as often round.
Cell SameWayRound(const LivelyDances& real, const std::vector<LivelyDances>& keyed) {
  std::vector<ClipFigure> windows;
  for (const LivelyDances& seed : keyed) {
    for (size_t i = 0; i < seed.size(); ++i) {
      for (size_t w = 0; w < std::min(real[i].turns.size(), seed[i].turns.size()); ++w) {
        if (std::abs(real[i].turns[w]) * kDegrees <= kTurn) continue;
        const bool same = std::abs(real[i].turns[w] - seed[i].turns[w]) * kDegrees < 180;
        windows.push_back({real[i].clip, same ? 100.0 : 0.0});
      }
    }
  }
  return Mean(windows);
}

}  // namespace

std::vector<Table> WeightTable(const Evaluation& evaluation, const Method& method,
                               const LivelyDances& real, const std::vector<LivelyDances>& keyed,
                               const LivelyDances& free) {
  const ModelInfo& model = method.engine->model();
  if (real.empty() || !BalanceGauge::Fits(model.skeleton)) return {};
  const auto weigh = [&](const LivelyDances& dances) {
    WeighedDances weighed;
    for (const LivelyFigures& one : dances)
      weighed.push_back(Weigh(model.skeleton, model.fps, one.clip, one.track, one.turns));
    return weighed;
  };
  WeighedDances others, danced;
  if (evaluation.training != nullptr) {
    for (size_t i = 0; i < evaluation.training->clips.size(); ++i) {
      const PreparedClip& clip = evaluation.training->clips[i];
      others.push_back(Weigh(clip.skeleton, clip.motion.fps, i,
                             TrackJoints(clip.skeleton, clip.motion.frames),
                             WindowTurns(clip.motion.frames, clip.motion.fps)));
    }
  }
  for (const LivelyDances& seed : keyed) std::ranges::copy(weigh(seed), std::back_inserter(danced));
  const WeighedDances theirs = weigh(real), freely = weigh(free);

  Table table = evaluation.NewTable("weight", "Has she weight", {"figure"}, &method);
  const auto put = [&](const std::string& name, Cell of_real, Cell of_others, Cell of_keyed,
                       Cell of_free) {
    table.Begin({name});
    table.Put("real motion", 2, of_real);
    table.Put("other dancers", 2, of_others);
    table.Put("keyed", 2, of_keyed);
    table.Put("free", 2, of_free);
  };
  const auto add = [&](const std::string& name, auto figure, double unit) {
    const auto mean = [&](const WeighedDances& some) { return MeanOfKnown(some, figure, unit); };
    put(name, mean(theirs), mean(others), mean(danced), mean(freely));
  };
  const auto weight = [](double WeightFigures::*figure) {
    return [figure](const Weighed& one) { return one.weight.*figure; };
  };
  add("both feet > 5 cm above the floor %", weight(&WeightFigures::hover_share), 100);
  add("vertical acceleration there m/s²", weight(&WeightFigures::hover_acceleration), 1);
  add("longest hover s", weight(&WeightFigures::longest_hover_s), 1);
  add("zero moment point > 15 cm outside the feet %", weight(&WeightFigures::zmp_outside), 100);
  add("centre of mass > 10 cm outside the feet %", weight(&WeightFigures::centre_outside), 100);
  add("supported %", weight(&WeightFigures::supported), 100);
  add("a foot's contact, median frames", weight(&WeightFigures::contact_frames), 1);
  add("windows that turn > 150° %", std::mem_fn(&Weighed::half_turns), 100);
  add("windows that turn > 270° %", std::mem_fn(&Weighed::whole_turns), 100);
  put("turns > 60° that go the real way round %", 100, {}, SameWayRound(real, keyed), {});
  add("hands at rest %", std::mem_fn(&Weighed::at_rest), 100);
  const auto spread = [](const Weighed& one) { return one.spread; };
  const double real_spread = MeanOfKnown(theirs, spread, 1).value;
  const auto over_real = [&](const WeighedDances& some) {
    return MeanOfKnown(some, spread, 1 / real_spread);
  };
  put("spread between windows ÷ real", 1, over_real(others), over_real(danced), over_real(freely));
  table.note = std::to_string(real.size()) + " clips, " + std::to_string(keyed.size()) +
               " seeds, keys each 2 s; free: " + std::to_string(free.size()) +
               " dances without keys. Other dancers: the real ones of the training clips. Windows "
               "are 2 s.";
  return {table};
}

}  // namespace choreo
