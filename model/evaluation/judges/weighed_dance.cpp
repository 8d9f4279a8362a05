#include "model/evaluation/judges/weighed_dance.h"

#include <algorithm>
#include <cmath>

#include "model/metrics/contrast.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kHalfTurn = 150, kWholeTurn = 270, kBent = 45;  // degrees

constexpr WeightRow kRows[] = {
    {"both feet > 5 cm above the floor %",
     [](const WeighedDance& one) { return one.weight.hover_share; }, 100},
    {"vertical acceleration there m/s²",
     [](const WeighedDance& one) { return one.weight.hover_acceleration; }, 1},
    {"longest hover s", [](const WeighedDance& one) { return one.weight.longest_hover_s; }, 1},
    {"zero moment point > 15 cm outside the feet %",
     [](const WeighedDance& one) { return one.weight.zmp_outside; }, 100},
    {"centre of mass > 10 cm outside the feet %",
     [](const WeighedDance& one) { return one.weight.centre_outside; }, 100},
    {"supported %", [](const WeighedDance& one) { return one.weight.supported; }, 100},
    {"a foot's contact, median frames",
     [](const WeighedDance& one) { return one.weight.contact_frames; }, 1},
    {"windows that turn > 150° %", [](const WeighedDance& one) { return one.half_turns; }, 100},
    {"windows that turn > 270° %", [](const WeighedDance& one) { return one.whole_turns; }, 100},
    {"trunk's lean, median °", [](const WeighedDance& one) { return one.lean; }, 1},
    {"trunk leans > 45° %", [](const WeighedDance& one) { return one.bent; }, 100},
    {"hands at rest %", [](const WeighedDance& one) { return one.at_rest; }, 100},
};

double ShareBeyond(const std::vector<double>& turns, double degrees) {
  if (turns.empty()) return NAN;
  const auto wide = std::ranges::count_if(
      turns, [&](double turn) { return std::abs(turn) * kDegrees > degrees; });
  return static_cast<double>(wide) / static_cast<double>(turns.size());
}

}  // namespace

WeighedDance Weigh(const Skeleton& skeleton, double fps, size_t clip, const JointTrack& track,
                   const std::vector<double>& turns) {
  const double floor = DancedFloor(skeleton, track);
  std::vector<double> lean = TrunkLean(skeleton, track);
  std::ranges::sort(lean);
  const auto bent = std::ranges::count_if(lean, [](double angle) { return angle > kBent; });
  WeighedDance weighed{.clip = clip,
                       .weight = MeasureWeight(skeleton, fps, track, floor),
                       .floor = floor,
                       .half_turns = ShareBeyond(turns, kHalfTurn),
                       .whole_turns = ShareBeyond(turns, kWholeTurn),
                       .lean = lean.empty() ? NAN : lean[lean.size() / 2],
                       .bent = static_cast<double>(bent) / static_cast<double>(lean.size()),
                       .at_rest = HandsAtRest(skeleton, fps, track),
                       .spread = PaceSpread(fps, track),
                       .windows = {}};
  AddFamilies(skeleton, fps, track, floor, clip, &weighed.windows);
  return weighed;
}

std::span<const WeightRow> WeightRows() { return kRows; }

Cell MeanOfKnown(const WeighedDances& dances, double (*figure)(const WeighedDance&), double unit) {
  std::vector<ClipFigure> figures = FiguresOf(dances, figure, unit);
  std::erase_if(figures, [](const ClipFigure& one) { return std::isnan(one.value); });
  return Mean(figures);
}

}  // namespace choreo
