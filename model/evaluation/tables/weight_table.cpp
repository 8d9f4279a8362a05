#include "model/evaluation/tables/weight_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "model/evaluation/judges/weighed_dance.h"
#include "model/metrics/contrast.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kTurn = 60;  // degrees

// The share of windows with a real turn in which dances turn the same way by as many half turns.
Cell SameWayRound(const LivelinessDances& real, const std::vector<LivelinessDances>& keyed) {
  std::vector<ClipFigure> windows;
  for (const LivelinessDances& seed : keyed) {
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

FamilyWindows WindowsOf(const WeighedDances& dances) {
  FamilyWindows all;
  for (const WeighedDance& dance : dances) {
    for (size_t family = 0; family < all.size(); ++family) {
      const CriticWindows& some = dance.windows[family];
      std::ranges::copy(some.features, std::back_inserter(all[family].features));
      std::ranges::copy(some.clips, std::back_inserter(all[family].clips));
    }
  }
  return all;
}

// The kinds of motion compared.
struct Weighed {
  WeighedDances real, others, footwork, keyed, free;
};

Weighed WeighAll(const Evaluation& evaluation, const ModelInfo& model, const LivelinessDances& real,
                 const LivelinessDances& footwork, const std::vector<LivelinessDances>& keyed,
                 const LivelinessDances& free) {
  const auto weigh = [&](const LivelinessDances& dances, WeighedDances* to) {
    for (const LivelinessFigures& one : dances)
      to->push_back(Weigh(model.skeleton, model.fps, one.clip, one.track, one.turns));
  };
  Weighed all;
  weigh(real, &all.real);
  weigh(footwork, &all.footwork);
  for (const LivelinessDances& seed : keyed) weigh(seed, &all.keyed);
  weigh(free, &all.free);
  if (evaluation.training == nullptr) return all;
  for (size_t i = 0; i < evaluation.training->clips.size(); ++i) {
    const PreparedClip& clip = evaluation.training->clips[i];
    all.others.push_back(Weigh(clip.skeleton, clip.motion.fps, i,
                               TrackJoints(clip.skeleton, clip.motion.frames),
                               WindowTurns(clip.motion.frames, clip.motion.fps)));
  }
  return all;
}

void PutWeights(const std::string& name, Cell real, Cell others, Cell footwork, Cell keyed,
                Cell free, Table* table) {
  table->AddRow({name});
  table->Put("real motion", 2, real);
  table->Put("other dancers", 2, others);
  table->Put("real, footwork", 2, footwork);
  table->Put("keyed", 2, keyed);
  table->Put("free", 2, free);
}

void AddSpread(const Weighed& all, Table* table) {
  const auto mean = [](const WeighedDances& dances, double unit) {
    return MeanOfKnown(
        dances, [](const WeighedDance& one) { return one.spread; }, unit);
  };
  const double real = mean(all.real, 1).value;
  PutWeights("spread between windows ÷ real", 1, mean(all.others, 1 / real),
             mean(all.footwork, 1 / real), mean(all.keyed, 1 / real), mean(all.free, 1 / real),
             table);
}

void AddCritics(const Weighed& all, Table* table) {
  const FamilyWindows real = WindowsOf(all.real);
  const auto others = FamilyAreas(real, WindowsOf(all.others));
  const auto footwork = FamilyAreas(real, WindowsOf(all.footwork));
  const auto keyed = FamilyAreas(real, WindowsOf(all.keyed));
  const auto free = FamilyAreas(real, WindowsOf(all.free));
  for (size_t family = 0; family < kCriticFamilies.size(); ++family) {
    PutWeights("critic's area, " + std::string(kCriticFamilies[family]), {}, others[family],
               footwork[family], keyed[family], free[family], table);
  }
}

}  // namespace

std::vector<Table> WeightTable(const Evaluation& evaluation, const Method& method,
                               const LivelinessDances& real, const LivelinessDances& footwork,
                               const std::vector<LivelinessDances>& keyed,
                               const LivelinessDances& free) {
  const ModelInfo& model = method.sampler->model();
  if (real.empty() || !BalanceGauge::Fits(model.skeleton)) return {};
  const Weighed all = WeighAll(evaluation, model, real, footwork, keyed, free);
  Table table = evaluation.NewTable("weight", "Has she weight", {"figure"}, &method);
  for (const WeightRow& row : WeightRows()) {
    const auto mean = [&](const WeighedDances& dances) {
      return MeanOfKnown(dances, row.figure, row.unit);
    };
    PutWeights(row.name, mean(all.real), mean(all.others), mean(all.footwork), mean(all.keyed),
               mean(all.free), &table);
  }
  AddSpread(all, &table);
  PutWeights("turns > 60° that go the real way round %", 100, {}, SameWayRound(real, {footwork}),
             SameWayRound(real, keyed), {}, &table);
  AddCritics(all, &table);
  table.note = std::to_string(real.size()) + " clips, " + std::to_string(keyed.size()) +
               " seeds, keys each 2 s; free: " + std::to_string(free.size()) +
               " dances without keys. Other dancers: the real ones of the training clips. Windows "
               "are 2 s; a critic's area is how often it tells one of real motion from one that "
               "is not.";
  return {table};
}

}  // namespace choreo
