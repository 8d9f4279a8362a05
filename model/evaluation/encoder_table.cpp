#include "model/evaluation/encoder_table.h"

#include <algorithm>

#include "model/evaluation/long_plans.h"
#include "model/metrics/frechet.h"

namespace choreo {
namespace {

constexpr int kBlock = 150;   // frames
constexpr int kInputs = 8;    // of variability and diversity
constexpr int kSamples = 15;  // of an input, as in the paper
constexpr int kFrames = 300;  // of each dance, at most

// Inputs one after another, the samples of each together.
std::vector<LongPlan> Plans(const ClipSet& set, const Method& method, const EvalOptions& options) {
  const KeyTimes times = method.keys ? KeyTimes::kEachTwoSeconds : KeyTimes::kNone;
  std::vector<LongPlan> plans;
  for (const LongPlan& input :
       PlanLongDances(method.engine->model(), set, times, kInputs, Shorter(options, kFrames))) {
    for (int sample = 0; sample < kSamples; ++sample) {
      plans.push_back(input);
      plans.back().chain.seed += static_cast<uint64_t>(1000 * sample);
    }
  }
  return plans;
}

Eigen::MatrixXd Join(const std::vector<Eigen::MatrixXd>& parts) {
  Eigen::Index columns = 0;
  for (const Eigen::MatrixXd& part : parts) columns += part.cols();
  Eigen::MatrixXd all(parts.empty() ? 0 : parts[0].rows(), columns);
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    all.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return all;
}

// Mean squared distance of corresponding windows of two dances, over their common length.
double Apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::Index common = std::min(a.cols(), b.cols());
  if (common == 0) return 0;
  return (a.leftCols(common) - b.leftCols(common)).colwise().squaredNorm().mean();
}

TableRow RowOf(const Method& method, const std::vector<LongPlan>& plans,
               const std::vector<Chain>& chains, const MotionEncoder& encoder,
               const Eigen::MatrixXd& reference) {
  std::vector<Eigen::MatrixXd> codes;
  for (const Chain& chain : chains)
    codes.push_back(encoder.Encode(method.engine->model().skeleton, chain.poses));
  double variability = 0;
  std::vector<Eigen::MatrixXd> firsts;
  const size_t inputs = plans.size() / kSamples;
  for (size_t input = 0; input < inputs; ++input) {
    const auto first = codes.begin() + static_cast<std::ptrdiff_t>(input * kSamples);
    variability += MeanApart({first, first + kSamples}) / static_cast<double>(inputs);
    firsts.push_back(*first);
  }
  const Eigen::MatrixXd all = Join(codes);
  return {{method.name},
          {Cell{all.cols() > 1 ? FrechetDistance(all, reference) : NAN, {}}, Cell{variability, {}},
           Cell{MeanApart(firsts), {}}}};
}

}  // namespace

double MeanApart(const std::vector<Eigen::MatrixXd>& dances) {
  double sum = 0;
  int pairs = 0;
  for (size_t i = 0; i < dances.size(); ++i) {
    for (size_t k = 0; k < i; ++k, ++pairs) sum += Apart(dances[i], dances[k]);
  }
  return pairs > 0 ? sum / pairs : 0;
}

Table EvaluateEncoded(const ClipSet& set, const std::vector<Method>& methods,
                      const MotionEncoder& encoder, const EvalOptions& options,
                      ProgressBar* progress) {
  std::vector<Eigen::MatrixXd> even, odd;
  for (const PreparedClip& clip : set.clips) {
    const std::span<const Pose> poses(clip.motion.frames);
    for (size_t block = 0; (block + 1) * kBlock <= poses.size(); ++block) {
      (block % 2 == 0 ? even : odd)
          .push_back(encoder.Encode(clip.skeleton, poses.subspan(block * kBlock, kBlock)));
    }
  }
  const Eigen::MatrixXd reference = Join(even);
  Table table;
  table.name = "encoder_" + set.name;
  table.title = "FID, variability, diversity, " + set.name;
  char explained[32];
  std::snprintf(explained, sizeof(explained), "%.1f %%", 100 * encoder.explained());
  table.note = "Codes of the motion encoder " + encoder.version() + ", which explains " +
               explained +
               " of training motion. Dances of 10 s, keys each 2 s where there are "
               "keys; units: standard deviations of training motion's codes, squared. FID to every "
               "other 5 s of the real clips, whose remaining seconds are the row of real motion.";
  table.label_headings = {"method"};
  table.columns = {{"FID", 2}, {"variability", 2}, {"diversity", 1}};
  if (reference.cols() < 2) return table;
  for (const Method& method : methods) {
    if (method.kind == Method::Kind::kReal && !odd.empty()) {
      table.rows.push_back(
          {{method.name},
           {Cell{FrechetDistance(Join(odd), reference), {}}, Cell{}, Cell{MeanApart(odd), {}}}});
    }
    if (method.kind != Method::Kind::kEngine) continue;
    const std::vector<LongPlan> plans = Plans(set, method, options);
    std::vector<ChainPlan> chains;
    for (const LongPlan& plan : plans) chains.push_back(plan.chain);
    const std::vector<Chain> danced = DanceChains(*method.engine, chains, [&](int frames) {
      if (progress != nullptr) progress->Advance(frames, set.name + ", samples");
    });
    table.rows.push_back(RowOf(method, plans, danced, encoder, reference));
  }
  return table;
}

int64_t CountEncodedFrames(const ClipSet& set, const std::vector<Method>& methods,
                           const EvalOptions& options) {
  int64_t frames = 0;
  for (const Method& method : methods) {
    if (method.kind != Method::Kind::kEngine) continue;
    for (const LongPlan& plan : Plans(set, method, options)) frames += plan.chain.frames;
  }
  return frames;
}

}  // namespace choreo
