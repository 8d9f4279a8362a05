#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/dance/transition_group.h"

namespace choreo {

void RankCandidates(std::vector<CandidateReport>& candidates, RankBy by) {
  constexpr double kSteeredStep = 0.01;  // metres
  constexpr double kSkateStep = 0.01;
  constexpr double kSupportStep = 0.05;  // three frames in two seconds
  std::ranges::sort(candidates, {}, [by](const CandidateReport& report) {
    const QualityReport& quality = report.quality;
    const double unlikely = -quality.log_likelihood.value_or(0);
    if (by == RankBy::kLikelihood)
      return std::tuple(0.0, 0.0, 0.0, 0.0, unlikely, report.candidate);
    const double steered = quality.keys.empty() ? 0 : quality.keys.front().correction_m;
    const double unsupported = 1 - quality.support.value_or(1);
    return std::tuple(report.strain, std::floor(steered / kSteeredStep),
                      std::floor(unsupported / kSupportStep),
                      std::floor(quality.skate_ratio / kSkateStep), unlikely, report.candidate);
  });
}

}  // namespace choreo
