#include "model/flow/variety.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>

#include "model/flow/torch_kinematics.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr int64_t kBins = 8;
constexpr double kSlowest = 1.0 / 300, kFastest = 0.1;  // cycles a frame
constexpr double kLeastActivity = 1e-3;                 // radians a frame and joint
constexpr double kLeastSpread = 1e-4;
constexpr double kRampFrames = 6;  // over which variety grows from the history, fades to the key

// [batch, 1]: 1 where there is a key, be it of some joints.
Tensor Keyed(const TransitionTensors& transition) {
  return transition.target_mask.amax(1, /*keepdim=*/true);
}

// Half waves of each sine in N frames: 1, 2, ... where it ends at the key; 1/2, 3/2, ... where it
// ends freely. [batch, waves]
Tensor HalfWaves(const Tensor& keyed, int64_t waves) {
  return torch::arange(1, waves + 1, keyed.options()).unsqueeze(0) - 0.5 * (1 - keyed);
}

// Orthonormal over the N frames, the last of which counts half where it is free. [batch, waves, N]
Tensor Sines(const Tensor& keyed, int64_t waves, int64_t frames) {
  const Tensor t = torch::arange(1, frames + 1, keyed.options()) / static_cast<double>(frames);
  return std::sqrt(2.0 / static_cast<double>(frames)) *
         (M_PI * HalfWaves(keyed, waves).unsqueeze(-1) * t).sin();
}

// Where each wave's frequency stands between the bins, which are even in its logarithm.
// [batch, waves], 0 to kBins - 1.
Tensor Bin(const Tensor& keyed, int64_t waves, int64_t frames) {
  const Tensor frequency = HalfWaves(keyed, waves) / (2.0 * static_cast<double>(frames));
  const double range = std::log(kFastest / kSlowest);
  return ((frequency / kSlowest).log() * ((kBins - 1) / range)).clamp(0, kBins - 1);
}

// How lively the dancer is: logarithms of the mean angle that a joint turns in a frame, over the
// history and on the way to what the key names, behind a 1. [batch, 3]
Tensor Activity(const TransitionTensors& transition) {
  const Tensor& history = transition.history_rotation;
  const int64_t steps = history.size(1) - 1, joints = history.size(2);
  const Tensor asked = transition.target_mask.narrow(1, 0, joints);
  const auto turn = [](const Tensor& a, const Tensor& b) {
    return LogMapBatch(torch::matmul(a.transpose(-1, -2), b)).square().sum(-1).sqrt();
  };
  const Tensor lately = turn(history.narrow(1, 0, steps), history.narrow(1, 1, steps)).mean({1, 2});
  const Tensor way = (turn(history.select(1, steps), transition.target_rotation) * asked).sum(1) /
                     (asked.sum(1).clamp_min(1) * static_cast<double>(transition.frames));
  return torch::stack({torch::ones_like(way), lately.clamp_min(kLeastActivity).log(),
                       way.clamp_min(kLeastActivity).log()},
                      1);
}

}  // namespace

VarietyImpl::VarietyImpl(int joints, int components) {
  const int64_t width = 3 + 3 * joints;
  basis_ = register_buffer("basis", torch::zeros({components, width}));
  analysis_ = register_buffer("analysis", torch::zeros({width, components}));
  spread_ = register_buffer("spread", torch::full({2, kBins, components}, std::log(kLeastSpread)));
  activity_ = register_buffer("activity", torch::zeros({2, 3}));
}

Tensor VarietyImpl::Difference(const TrajectoryTensors& plan, const TrajectoryTensors& truth) {
  const Tensor turn = LogMapBatch(torch::matmul(plan.rotation.transpose(-1, -2), truth.rotation));
  return torch::cat({truth.position - plan.position, turn.flatten(2)}, -1);
}

Tensor VarietyImpl::Analyse(const Tensor& difference, const Tensor& keyed) const {
  const int64_t frames = difference.size(1);
  Tensor sines = Sines(keyed, Waves(frames), frames);
  sines.select(2, frames - 1).mul_(0.5 * (1 + keyed));
  return torch::matmul(sines, torch::matmul(difference, analysis_));
}

Tensor VarietyImpl::Synthesise(const Tensor& coefficients, const Tensor& keyed,
                               int64_t frames) const {
  const Tensor sines = Sines(keyed, coefficients.size(1), frames);
  const Tensor smooth = torch::matmul(torch::matmul(sines.transpose(1, 2), coefficients), basis_);
  // Sines leave history and key with a kink.
  const Tensor since = torch::arange(1, frames + 1, keyed.options());
  const Tensor to_key = ((frames - since) / kRampFrames).clamp_max(1);
  const Tensor ramp = (since / kRampFrames).clamp_max(1) * (1 - keyed + keyed * to_key);
  return smooth * ramp.unsqueeze(-1);
}

Tensor VarietyImpl::Factor(const TransitionTensors& transition, const Tensor& keyed) const {
  const Tensor lines = activity_.index({keyed.squeeze(1).to(torch::kLong)});  // [batch, 3]
  return (lines * Activity(transition)).sum(1);
}

Tensor VarietyImpl::Spread(const TransitionTensors& transition, const Tensor& keyed,
                           int64_t waves) const {
  const Tensor place = Bin(keyed, waves, transition.frames).clamp_max(kBins - 1.001);
  const Tensor bin = place.floor(), part = (place - bin).unsqueeze(-1);
  const Tensor kind = keyed.to(torch::kLong).expand_as(bin), below = bin.to(torch::kLong);
  const Tensor log_spread =
      (1 - part) * spread_.index({kind, below}) + part * spread_.index({kind, below + 1});
  return (log_spread + Factor(transition, keyed).view({-1, 1, 1})).exp();
}

TrajectoryTensors VarietyImpl::Vary(const TransitionTensors& transition,
                                    const TrajectoryTensors& plan,
                                    const Tensor& coefficients) const {
  if (coefficients.size(1) == 0) return plan;
  const Tensor keyed = Keyed(transition);
  const Tensor physical = coefficients * Spread(transition, keyed, coefficients.size(1));
  const Tensor difference = Synthesise(physical, keyed, transition.frames);
  const Tensor turn = difference.narrow(2, 3, difference.size(2) - 3).unflatten(2, {-1, 3});
  return {plan.position + difference.narrow(2, 0, 3),
          torch::matmul(plan.rotation, ExpMapBatch(turn))};
}

TrajectoryTensors VarietyImpl::Approach(const TransitionTensors& transition,
                                        const TrajectoryTensors& plan,
                                        const TrajectoryTensors& truth) const {
  const Tensor keyed = Keyed(transition);
  const int64_t waves = Waves(transition.frames);
  if (waves == 0) return plan;
  return Vary(transition, plan,
              Analyse(Difference(plan, truth), keyed) / Spread(transition, keyed, waves));
}

void VarietyImpl::Fit(const std::vector<Sample>& samples) {
  torch::NoGradGuard no_grad;
  std::vector<Tensor> rows;
  for (const Sample& sample : samples) rows.push_back(sample.difference.flatten(0, 1));
  const Tensor all = torch::cat(rows);
  const Tensor std = all.square().mean(0).sqrt().clamp_min(kLeastSpread);
  const Tensor standard = all / std;
  const Tensor covariance = torch::matmul(standard.t(), standard) / standard.size(0);
  const Tensor vectors = std::get<1>(torch::linalg_eigh(covariance, "L")).flip(1);
  const Tensor principal = vectors.narrow(1, 0, components());  // [width, components]
  basis_.copy_(principal.t() * std);
  analysis_.copy_(principal / std.unsqueeze(1));

  // The common factor: the logarithm of a window's coefficients' size, a plane over its activities.
  std::vector<Tensor> analysed, sizes[2], activities[2];
  for (const Sample& sample : samples) {
    const Tensor keyed = Keyed(sample.transition);
    analysed.push_back(Analyse(sample.difference, keyed));
    if (analysed.back().size(1) == 0) continue;  // too short for a wave
    const auto kind = static_cast<size_t>(keyed[0].item<float>());
    sizes[kind].push_back(analysed.back().abs().mean({1, 2}).add(kLeastSpread).log());
    activities[kind].push_back(Activity(sample.transition));
  }
  for (size_t kind = 0; kind < 2; ++kind) {
    if (sizes[kind].empty()) continue;
    const Tensor x = torch::cat(activities[kind]), y = torch::cat(sizes[kind]).unsqueeze(1);
    // Without a key the way's column is constant: a ridge keeps that solvable.
    const Tensor normal = torch::matmul(x.t(), x) + 1e-3 * torch::eye(3, x.options());
    activity_[static_cast<int64_t>(kind)] =
        torch::linalg_solve(normal, torch::matmul(x.t(), y), true).squeeze(1);
  }

  // Sizes bin by bin. With a key their median, so that wild windows do not shake calm ones; without
  // one their mean, since the wild ones are what keeps such a dance from standing.
  std::vector<Tensor> seen_in[2][kBins];
  for (size_t i = 0; i < samples.size(); ++i) {
    const TransitionTensors& transition = samples[i].transition;
    const Tensor keyed = Keyed(transition);
    const Tensor size = (analysed[i] / Factor(transition, keyed).exp().view({-1, 1, 1})).abs();
    const Tensor bin = Bin(keyed, size.size(1), transition.frames)[0].round();
    const auto kind = static_cast<size_t>(keyed[0].item<float>());
    for (int64_t wave = 0; wave < size.size(1); ++wave)
      seen_in[kind][static_cast<size_t>(bin[wave].item<float>())].push_back(size.select(1, wave));
  }
  constexpr double kMedianOfUnit = 0.6745, kMeanOfUnit = 0.7979;  // of a standard normal's size
  for (int64_t kind = 0; kind < 2; ++kind) {
    std::vector<int64_t> seen;
    for (int64_t bin = 0; bin < kBins; ++bin)
      if (!seen_in[kind][bin].empty()) seen.push_back(bin);
    // A bin that no window reached has its neighbour's spread.
    for (int64_t bin = 0; bin < kBins && !seen.empty(); ++bin) {
      const auto nearest = std::ranges::min_element(
          seen, {}, [bin](int64_t other) { return std::abs(other - bin); });
      const Tensor size = torch::cat(seen_in[kind][*nearest]);
      const Tensor spread =
          kind == 1 ? std::get<0>(size.median(0)) / kMedianOfUnit : size.mean(0) / kMeanOfUnit;
      spread_[kind][bin] = spread.clamp_min(kLeastSpread).log();
    }
  }
}

}  // namespace choreo
