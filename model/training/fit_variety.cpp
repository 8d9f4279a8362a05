#include "model/training/fit_variety.h"

#include <algorithm>

namespace choreo {
namespace {

constexpr int kBatches = 160, kLengths = 10;
constexpr int kShortest = 2;

}  // namespace

void FitVariety(const ClipStore& clips, int batch, int longest, uint64_t seed, torch::Device device,
                FlowModel* model) {
  FlowModel& flow = *model;
  std::vector<VarietyImpl::Sample> samples;
  for (int i = 0; i < kBatches; ++i) {
    Random random(seed + 11, static_cast<uint32_t>(i + 1));
    const int frames = std::max(kShortest, longest * (1 + i % kLengths) / kLengths);
    const bool keyed = i / kLengths % 2 == 0;
    const ClipStore::Variation variation{.mirror = true, .drop_key = keyed ? 0.0 : 1.0};
    const MotionBatch drawn =
        clips.Draw(batch, flow->config().history_frames, frames, variation, &random)
            .WithItsTurning()
            .To(device);
    const TrajectoryTensors plan = flow->Begin(drawn.transition).reference;
    samples.push_back({drawn.transition, VarietyImpl::Difference(plan, drawn.truth)});
  }
  flow->variety()->Fit(samples);
}

}  // namespace choreo
