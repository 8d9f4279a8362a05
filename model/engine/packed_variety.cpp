#include "model/engine/packed_variety.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/core/random.h"
#include "model/engine/temperature.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// As model/flow/variety.cpp has them; the parity test holds both together.
constexpr int kBins = 8;
constexpr double kSlowest = 1.0 / 300, kFastest = 0.1;
constexpr double kLeastActivity = 1e-3;
constexpr double kRampFrames = 6;

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return RotationDifference(a, b).norm();
}

}  // namespace

PackedVariety::PackedVariety(const PackedTensors& tensors, const Skeleton& skeleton, int components)
    : skeleton_(skeleton),
      basis_(tensors.Get("variety.basis", components, 3 + 3 * skeleton.joints())) {
  const float* spread = tensors.Get("variety.spread", {2, kBins, components}).data();
  const auto activity = tensors.Get("variety.activity", 2, 3);
  for (int kind = 0; kind < 2; ++kind, spread += static_cast<long>(kBins) * components) {
    spread_[kind] = Eigen::Map<const RowMajorMatrix>(spread, kBins, components);
    activity_[kind] = activity.row(kind);
  }
}

// How lively the dancer is, over the history and on the way to what the key names: the factor that
// all coefficients share.
float PackedVariety::Factor(const TransitionSpec& spec) const {
  const auto joints = static_cast<int>(spec.history.back().rotations.cols());
  const auto steps = spec.history.size() - 1;
  double lately = 0, way = 0, asked = 0;
  for (int joint = 0; joint < joints; ++joint) {
    for (size_t t = 0; t < steps; ++t)
      lately += AngleBetween(spec.history[t].rotations.col(joint),
                             spec.history[t + 1].rotations.col(joint));
    if (!spec.target || !spec.target->mask.Asks(joint)) continue;
    way += AngleBetween(spec.history.back().rotations.col(joint),
                        spec.target->pose.rotations.col(joint));
    ++asked;
  }
  const Eigen::Vector3f& weights = activity_[Keyed(spec) ? 1 : 0];
  const auto logarithm = [](double value) {
    return static_cast<float>(std::log(std::max(value, kLeastActivity)));
  };
  return weights[0] + weights[1] * logarithm(lately / (static_cast<double>(steps) * joints)) +
         weights[2] * logarithm(way / (std::max(asked, 1.0) * spec.frames));
}

bool PackedVariety::Sample(const TransitionSpec& spec, int skipped, Scratch* s) const {
  const int waves = spec.frames / 5, frames = spec.frames;
  const long components = basis_.rows(), width = basis_.cols();
  if (spec.temperature <= 0 || waves == 0) return false;
  const long count = skipped + waves * components;
  s->noise.Resize(1, count);
  FillNormal(spec.seed, spec.candidate, spec.first_frame,
             {s->noise.Row(0), static_cast<size_t>(count)});
  const bool keyed = Keyed(spec);
  const RowMajorMatrix& spread = spread_[keyed ? 1 : 0];
  const float factor = Factor(spec);
  const Liveliness liveliness = LivelinessOf(skeleton_, spec);

  s->waves.Resize(waves, width);
  for (int wave = 0; wave < waves; ++wave) {
    const double frequency = HalfWaves(wave, keyed) / (2.0 * frames);
    const double place =
        std::log(frequency / kSlowest) * (kBins - 1) / std::log(kFastest / kSlowest);
    const double bounded = std::clamp(place, 0.0, kBins - 1.001);
    const auto bin = static_cast<int>(bounded);
    const auto part = static_cast<float>(bounded - bin);
    auto row = s->waves.Part(wave, 0, width);
    row.setZero();
    const WaveShare share = ShareOf(spec, liveliness, wave, static_cast<int>(components));
    for (long i = 0; i < share.components; ++i) {
      const float size = std::exp((1 - part) * spread(bin, i) + part * spread(bin + 1, i) + factor);
      const float drawn = s->noise.Row(0)[skipped + wave * components + i];
      row += share.temperature * drawn * size * basis_.row(i);
    }
  }
  s->difference.Resize(frames, width);
  const double scale = std::sqrt(2.0 / frames);
  for (int frame = 0; frame < frames; ++frame) {
    const double since = frame + 1;
    // Sines leave history and key with a kink.
    const double ramp = std::min(since / kRampFrames, 1.0) *
                        (keyed ? std::min((frames - since) / kRampFrames, 1.0) : 1.0);
    auto out = s->difference.Part(frame, 0, width);
    out.setZero();
    for (int wave = 0; wave < waves; ++wave) {
      const double sine = std::sin(std::numbers::pi * HalfWaves(wave, keyed) * since / frames);
      out += static_cast<float>(ramp * scale * sine) * s->waves.Part(wave, 0, width);
    }
  }
  return true;
}

}  // namespace choreo
