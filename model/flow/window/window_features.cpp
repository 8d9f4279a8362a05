#include "model/flow/window/window_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/flow/window/time_embedding.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kTimeWidth = 16;       // per embedded frame count
constexpr double kMaxBeat = 27;      // frames: slower beats are halved, as dancers do
constexpr double kTypicalBeat = 15;  // frames
constexpr double kPathScale = 0.3;   // metres
constexpr int kBeatFeatures = 6;

// Offsets in a frame's features. The controls' features follow in the order of their rows, then the
// distances to the start and to the key.
constexpr int kIsHistory = 0, kBeat = 1, kFirstControl = kBeat + kBeatFeatures;

int FeaturesOf(const ControlRow& row) {
  return row.features == ControlFeatures::kOffMean ? 5 : 2 * row.channels;
}

int ControlsWidth(std::span<const ControlRow> rows) {
  int width = 0;
  for (const ControlRow& row : rows) width += FeaturesOf(row);
  return width;
}

// Fills in the features of a place control. `mean`: the mean way's offset from the history's last
// root.
void DescribeOff(const ControlCurve& curve, int frame, const Eigen::Vector3d& root,
                 const Eigen::Vector3d& mean, std::span<float> features) {
  Eigen::Vector3d off = curve.values.col(frame) - root;
  off -= mean;
  if (!curve.IsRequested(kPathHeight)) off.y() = 0;
  features[0] = 1;
  features[1] = curve.IsRequested(kPathHeight) ? 1 : 0;
  for (int axis = 0; axis < 3; ++axis)
    features[2 + static_cast<size_t>(axis)] = static_cast<float>(off[axis] / kPathScale);
}

void DescribeChannels(const ControlRow& row, const ControlCurve& curve, int frame,
                      const std::array<double, kBodyParts>& medians, std::span<float> features) {
  const auto channels = static_cast<size_t>(row.channels);
  for (size_t channel = 0; channel < channels; ++channel) {
    const auto at = static_cast<int>(channel);
    if (!curve.IsRequested(at)) continue;
    const double value = curve.values(at, frame);
    features[channel] = static_cast<float>(
        row.features == ControlFeatures::kLevel ? EnergyLevel(value, medians[channel]) : value);
    features[channels + channel] = 1;
  }
}

}  // namespace

std::optional<BeatPhase> PhaseAt(std::span<const double> beats, double at) {
  if (beats.size() < 2) return std::nullopt;
  auto next = std::ranges::upper_bound(beats, at);
  next = std::clamp(next, beats.begin() + 1, beats.end() - 1);
  double period = *next - *(next - 1);
  if (!(period > 0)) return std::nullopt;
  double since = (at - *(next - 1)) / period;
  if (period > kMaxBeat) {
    since *= 2;
    period /= 2;
  }
  return BeatPhase{since - std::floor(since), period};
}

int FrameFeatures(std::span<const ControlRow> controls) {
  return kFirstControl + ControlsWidth(controls) + 2 * kTimeWidth;
}

int WholeFeatures(const Skeleton& skeleton, const ContinuousFlowConfig& config) {
  const int joints = skeleton.joints(), dimensions = 3 + 3 * joints;
  // Rotations in 6D, height; velocity, way to the key, its mask; whether there is a key, and when.
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
  static const CountEmbedding embedding(kTimeWidth);
  const std::span<const ControlRow> rows = request.controls.rows();
  const int since = kFirstControl + ControlsWidth(rows), left = since + kTimeWidth;
  features.frames = Eigen::MatrixXf::Zero(FrameFeatures(rows), tau + frames);
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
          static_cast<float>(2 * std::log(beat->period / kTypicalBeat));
    }
    embedding.Fill(i, place(since));
    if (request.target) embedding.Fill(request.to_key - 1 - i, place(left));
    if (i < 0) continue;
    float* next = at.data() + kFirstControl;
    for (size_t control = 0; control < rows.size(); next += FeaturesOf(rows[control++])) {
      const ControlCurve& curve = request.controls[control];
      const std::span<float> own(next, static_cast<size_t>(FeaturesOf(rows[control])));
      if (!curve.IsGiven()) continue;
      if (rows[control].features == ControlFeatures::kOffMean) {
        DescribeOff(curve, i, last.root_position, window.mean().col(i).head<3>(), own);
      } else {
        DescribeChannels(rows[control], curve, i, config.median_factors, own);
      }
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
  for (int d = 0; d < dimensions; ++d) put(window.velocity()[d] / spread[d]);
  for (int d = 0; d < dimensions; ++d) put(window.displacement()[d]);
  for (int d = 0; d < dimensions; ++d) put(window.keyed()[static_cast<size_t>(d)] ? 1 : 0);
  put(request.target ? 1 : 0);
  if (request.target)
    embedding.Fill(8 * std::log2(request.to_key), {features.whole.data() + next, kTimeWidth});
  next += kTimeWidth;
  if (request.style >= 0) features.whole[next + request.style] = 1;
  return features;
}

}  // namespace choreo
