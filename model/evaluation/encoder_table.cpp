#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/evaluation/long_plans.h"
#include "model/evaluation/motion_encoder.h"
#include "model/metrics/frechet.h"
#include "model/metrics/linear.h"

namespace choreo {
namespace {

constexpr int kBlock = 150;       // frames
constexpr int kInputs = 8;        // of variability and diversity
constexpr int kSamples = 15;      // of an input, as in the paper
constexpr int kMostFrames = 300;  // of each dance, at most

// Inputs one after another, the samples of each together.
std::vector<LongPlan> Plans(const Evaluation& evaluation, const Method& method) {
  const KeyTimes times = method.keys ? KeyTimes::kEachTwoSeconds : KeyTimes::kNone;
  EvalOptions brief = evaluation.options;
  brief.long_frames = std::min(brief.long_frames, kMostFrames);
  std::vector<LongPlan> plans;
  for (const LongPlan& input :
       PlanLongDances(method.engine->model(), evaluation.set, times, kInputs, brief)) {
    for (int sample = 0; sample < kSamples; ++sample) {
      plans.push_back(input);
      plans.back().seed += static_cast<uint64_t>(1000 * sample);
    }
  }
  return plans;
}

}  // namespace

std::vector<Table> EvaluateEncoded(const Evaluation& evaluation) {
  if (evaluation.encoder == nullptr) return {};
  const MotionEncoder& encoder = *evaluation.encoder;
  std::vector<Eigen::MatrixXd> even, odd;
  for (const PreparedClip& clip : evaluation.set.clips) {
    const std::span<const Pose> poses(clip.motion.frames);
    for (size_t block = 0; (block + 1) * kBlock <= poses.size(); ++block) {
      (block % 2 == 0 ? even : odd)
          .push_back(encoder.Encode(clip.skeleton, poses.subspan(block * kBlock, kBlock)));
    }
  }
  const Eigen::MatrixXd reference = SideBySide(even);
  Table table = evaluation.NewTable("encoder", "FID, variability, diversity", {"method"});
  char explained[32];
  std::snprintf(explained, sizeof(explained), "%.1f %%", 100 * encoder.explained());
  table.note = "Codes of the motion encoder " + encoder.version() + ", which explains " +
               explained +
               " of training motion. Dances of 10 s, keys each 2 s where there are "
               "keys; units: standard deviations of training motion's codes, squared. FID to every "
               "other 5 s of the real clips, whose remaining seconds are the row of real motion.";
  if (reference.cols() < 2) return {table};
  const auto add = [&](const Method& method, const std::vector<Eigen::MatrixXd>& codes,
                       Cell variability, double diversity) {
    const Eigen::MatrixXd all = SideBySide(codes);
    table.Begin({method.name});
    table.Put("FID", 2, all.cols() > 1 ? FrechetDistance(all, reference) : NAN);
    table.Put("variability", 2, variability);
    table.Put("diversity", 1, diversity);
  };
  for (const Method& method : evaluation.methods) {
    if (method.kind == Method::Kind::kReal && !odd.empty()) add(method, odd, {}, MeanApart(odd));
    if (method.kind != Method::Kind::kEngine) continue;
    const std::vector<LongPlan> plans = Plans(evaluation, method);
    std::vector<Eigen::MatrixXd> codes, firsts;
    for (const LongDance& dance : evaluation.runner.DanceLong(*method.engine, plans))
      codes.push_back(encoder.Encode(method.engine->model().skeleton, dance.poses));
    const size_t inputs = plans.size() / kSamples;
    double variability = 0;
    for (auto first = codes.begin(); first != codes.end(); first += kSamples) {
      variability += MeanApart({first, first + kSamples}) / inputs;
      firsts.push_back(*first);
    }
    add(method, codes, variability, MeanApart(firsts));
  }
  return {table};
}

}  // namespace choreo
