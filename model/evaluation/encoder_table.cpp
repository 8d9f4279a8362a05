#include <algorithm>

#include "model/evaluation/long_plans.h"
#include "model/evaluation/motion_encoder.h"
#include "model/metrics/frechet.h"
#include "model/metrics/linear.h"

namespace choreo {
namespace {

constexpr int kBlock = 150;   // frames
constexpr int kInputs = 8;    // of variability and diversity
constexpr int kSamples = 15;  // of an input, as in the paper
constexpr int kFrames = 300;  // of each dance, at most

// Inputs one after another, the samples of each together.
std::vector<LongPlan> Plans(const Evaluation& evaluation, const Method& method) {
  const KeyTimes times = method.keys ? KeyTimes::kEachTwoSeconds : KeyTimes::kNone;
  EvalOptions brief = evaluation.options;
  brief.long_frames = std::min(brief.long_frames, kFrames);
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

void AddRow(const Method& method, Cell distance, Cell variability, Cell diversity, Table* table) {
  table->Begin({method.name});
  table->Put("FID", 2, distance);
  table->Put("variability", 2, variability);
  table->Put("diversity", 1, diversity);
}

void AddDances(const Method& method, const std::vector<LongPlan>& plans,
               const std::vector<LongDance>& chains, const MotionEncoder& encoder,
               const Eigen::MatrixXd& reference, Table* table) {
  std::vector<Eigen::MatrixXd> codes;
  for (const LongDance& chain : chains)
    codes.push_back(encoder.Encode(method.engine->model().skeleton, chain.poses));
  double variability = 0;
  std::vector<Eigen::MatrixXd> firsts;
  const size_t inputs = plans.size() / kSamples;
  for (size_t input = 0; input < inputs; ++input) {
    const auto first = codes.begin() + static_cast<std::ptrdiff_t>(input * kSamples);
    variability += MeanApart({first, first + kSamples}) / inputs;
    firsts.push_back(*first);
  }
  const Eigen::MatrixXd all = SideBySide(codes);
  AddRow(method, all.cols() > 1 ? FrechetDistance(all, reference) : NAN, variability,
         MeanApart(firsts), table);
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
  for (const Method& method : evaluation.methods) {
    if (method.kind == Method::Kind::kReal && !odd.empty()) {
      AddRow(method, FrechetDistance(SideBySide(odd), reference), {}, MeanApart(odd), &table);
    }
    if (method.kind != Method::Kind::kEngine) continue;
    const std::vector<LongPlan> plans = Plans(evaluation, method);
    const std::vector<LongDance> danced = evaluation.runner.DanceLong(*method.engine, plans);
    AddDances(method, plans, danced, encoder, reference, &table);
  }
  return {table};
}

}  // namespace choreo
