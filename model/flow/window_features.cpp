#include "model/flow/window_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/flow/time_embedding.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kTimeWidth = 16;       // of each embedded number of frames
constexpr double kLongestBeat = 27;  // frames: slower beats are halved, as dancers do
constexpr double kUsualBeat = 15;    // frames
constexpr double kPathScale = 0.3;   // metres
constexpr int kBeatFeatures = 6, kPathFeatures = 5, kEnergyFeatures = 2 * kBodyParts;

// Places in a frame's features.
constexpr int kIsHistory = 0, kBeat = 1, kPath = kBeat + kBeatFeatures,
              kEnergy = kPath + kPathFeatures, kSince = kEnergy + kEnergyFeatures,
              kLeft = kSince + kTimeWidth, kWidth = kLeft + kTimeWidth;

}  // namespace

std::optional<BeatPhase> PhaseAt(std::span<const double> beats, double at) {
  if (beats.size() < 2) return std::nullopt;
  auto next = std::ranges::upper_bound(beats, at);
  next = std::clamp(next, beats.begin() + 1, beats.end() - 1);
  double period = *next - *(next - 1);
  if (!(period > 0)) return std::nullopt;
  double since = (at - *(next - 1)) / period;
  if (period > kLongestBeat) {
    since *= 2;
    period /= 2;
  }
  return BeatPhase{since - std::floor(since), period};
}

int FrameFeatures() { return kWidth; }

int WholeFeatures(const Skeleton& skeleton, const ContinuousFlowConfig& config) {
  const int joints = skeleton.joints(), dimensions = 3 + 3 * joints;
  // Rotations in 6D, height; velocity, way to the key, what it fixes; whether there is one, when.
  return 6 * joints + 1 + 3 * dimensions + 1 + kTimeWidth + static_cast<int>(config.styles.size());
}

WindowFeatures DescribeWindow(const Skeleton& skeleton, const ContinuousFlowConfig& config,
                              const MotionPrior& prior, const WindowRequest& request,
                              const FlowWindow& window) {
  const int tau = static_cast<int>(request.history.size()), frames = window.frames();
  const int joints = skeleton.joints(), dimensions = prior.dimensions();
  const Pose& last = request.history.back();
  const Eigen::VectorXd spread = prior.VelocitySpread();
  WindowFeatures features;
  features.frames = Eigen::MatrixXf::Zero(kWidth, tau + frames);
  for (int t = 0; t < tau + frames; ++t) {
    const int i = t - tau;  // frame of the window
    auto at = features.frames.col(t);
    const auto place = [&](int first) { return std::span(at.data() + first, kTimeWidth); };
    at[kIsHistory] = i < 0 ? 1 : 0;
    if (const auto beat = PhaseAt(request.beats, i)) {
      const double angle = 2 * std::numbers::pi * beat->phase;
      at.segment<kBeatFeatures>(kBeat) << 1, static_cast<float>(std::sin(angle)),
          static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(2 * angle)),
          static_cast<float>(std::cos(2 * angle)),
          static_cast<float>(2 * std::log(beat->period / kUsualBeat));
    }
    EmbedCount(i, place(kSince));
    if (request.key) EmbedCount(request.to_key - 1 - i, place(kLeft));
    if (i < 0) continue;
    if (request.path.cols() > 0) {
      Eigen::Vector3d off = request.path.col(i) - last.root_position;
      off -= window.mean().col(i).head<3>();
      if (!request.path_heights) off.y() = 0;
      at[kPath] = 1;
      at[kPath + 1] = request.path_heights ? 1 : 0;
      at.segment<3>(kPath + 2) = (off / kPathScale).cast<float>();
    }
    for (int part = 0; part < kBodyParts && request.energy.cols() > 0; ++part) {
      if (!request.asked[static_cast<size_t>(part)]) continue;
      const double median = config.median_factors[static_cast<size_t>(part)];
      at[kEnergy + part] = static_cast<float>(EnergyLevel(request.energy(part, i), median));
      at[kEnergy + kBodyParts + part] = 1;
    }
  }

  features.whole = Eigen::VectorXf::Zero(WholeFeatures(skeleton, config));
  int next = 0;
  const auto put = [&](double value) { features.whole[next++] = static_cast<float>(value); };
  for (int j = 0; j < joints; ++j) {
    const Eigen::Matrix<double, 6, 1> six = SixDFromMatrix(ExpMap(last.rotations.col(j)));
    for (const double value : six) put(value);
  }
  put(last.root_position.y() - skeleton.pelvis_height);
  for (int d = 0; d < dimensions; ++d) {
    const double before = tau > 1 ? window.history()(d, tau - 2) : 0;
    put(-before / spread[d]);
  }
  for (int d = 0; d < dimensions; ++d) put(window.displacement()[d]);
  for (int d = 0; d < dimensions; ++d) put(window.keyed()[static_cast<size_t>(d)] ? 1 : 0);
  put(request.key ? 1 : 0);
  if (request.key)
    EmbedCount(8 * std::log2(request.to_key), {features.whole.data() + next, kTimeWidth});
  next += kTimeWidth;
  if (request.style >= 0) features.whole[next + request.style] = 1;
  return features;
}

}  // namespace choreo
