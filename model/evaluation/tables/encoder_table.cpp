#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/evaluation/judges/encoded_figures.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/evaluation/judges/motion_encoder.h"
#include "model/metrics/frechet.h"
#include "model/metrics/linear.h"

namespace choreo {
namespace {

constexpr int kBlock = 150;      // frames
constexpr int kInputs = 8;       // for variability and diversity
constexpr int kSamples = 15;     // per input, as in the paper
constexpr int kMaxFrames = 300;  // per dance, at most

// Inputs one after another, with the samples of each together.
std::vector<LongPlan> Plans(const Evaluation& evaluation, const Method& method) {
  const KeyTimes times = method.keys ? KeyTimes::kEachTwoSeconds : KeyTimes::kNone;
  EvalOptions brief = evaluation.options;
  brief.long_frames = std::min(brief.long_frames, kMaxFrames);
  std::vector<LongPlan> plans;
  for (const LongPlan& input :
       PlanLongDances(method.sampler->model(), evaluation.set, times, kInputs, brief)) {
    for (int sample = 0; sample < kSamples; ++sample) {
      plans.push_back(input);
      plans.back().temperature = evaluation.TemperatureOf(method);
      plans.back().finished = method.finished;
      plans.back().seed += static_cast<uint64_t>(1000 * sample);
    }
  }
  return plans;
}

// Blocks of real motion, split into even and odd ones.
struct RealCodes {
  std::vector<Eigen::MatrixXd> even, odd;
};

RealCodes EncodeReal(const Evaluation& evaluation) {
  RealCodes codes;
  for (const PreparedClip& clip : evaluation.set.clips) {
    const std::span<const Pose> poses(clip.motion.frames);
    for (size_t block = 0; (block + 1) * kBlock <= poses.size(); ++block) {
      (block % 2 == 0 ? codes.even : codes.odd)
          .push_back(
              evaluation.encoder->Encode(clip.skeleton, poses.subspan(block * kBlock, kBlock)));
    }
  }
  return codes;
}

}  // namespace

EncodedFigures MeasureEncoded(const Evaluation& evaluation, const Method& method) {
  EncodedFigures figures;
  if (evaluation.encoder == nullptr) return figures;
  const MotionEncoder& encoder = *evaluation.encoder;
  const RealCodes real = EncodeReal(evaluation);
  const Eigen::MatrixXd reference = SideBySide(real.even);
  if (reference.cols() < 2) return figures;
  const auto distance = [&](const Eigen::MatrixXd& all) {
    return all.cols() > 1 ? FrechetDistance(all, reference) : NAN;
  };
  if (method.kind == Method::Kind::kReal && !real.odd.empty()) {
    figures.fid = distance(SideBySide(real.odd));
    figures.diversity = MeanApart(real.odd);
  }
  if (method.kind != Method::Kind::kModel) return figures;
  const std::vector<LongPlan> plans = Plans(evaluation, method);
  std::vector<Eigen::MatrixXd> codes, firsts;
  for (const LongDance& dance : evaluation.runner.DanceLong(*method.sampler, plans))
    codes.push_back(encoder.Encode(method.sampler->model().skeleton, dance.poses));
  const size_t inputs = plans.size() / kSamples;
  figures.variability = 0;
  for (auto first = codes.begin(); first != codes.end(); first += kSamples) {
    figures.variability += MeanApart({first, first + kSamples}) / static_cast<double>(inputs);
    firsts.push_back(*first);
  }
  figures.fid = distance(SideBySide(codes));
  figures.diversity = MeanApart(firsts);
  return figures;
}

std::vector<Table> EvaluateEncoded(const Evaluation& evaluation) {
  if (evaluation.encoder == nullptr) return {};
  const MotionEncoder& encoder = *evaluation.encoder;
  Table table = evaluation.NewTable("encoder", "FID, variability, diversity", {"method"});
  char explained[32];
  std::snprintf(explained, sizeof(explained), "%.1f %%", 100 * encoder.explained());
  table.note = "Codes of the motion encoder " + encoder.version() + ", which explains " +
               explained +
               " of training motion. Dances of 10 s, keys each 2 s where there are "
               "keys; units: standard deviations of training motion's codes, squared. FID to every "
               "other 5 s of the real clips, whose remaining seconds are the row of real motion.";
  const RealCodes real = EncodeReal(evaluation);
  if (SideBySide(real.even).cols() < 2) return {table};
  for (const Method& method : evaluation.methods) {
    if (method.kind == Method::Kind::kInterpolation) continue;
    if (method.kind == Method::Kind::kReal && real.odd.empty()) continue;
    const EncodedFigures figures = MeasureEncoded(evaluation, method);
    table.AddRow({method.name});
    table.Put("FID", 2, figures.fid);
    table.Put("variability", 2, figures.variability);
    table.Put("diversity", 1, figures.diversity);
  }
  return {table};
}

}  // namespace choreo
