#include "model/fit/sources/position_clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/core/error.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// One pass of a second-order section over all coordinates of all joints at once.
struct Biquad {
  double b0, b1, b2, a1, a2;

  void Run(std::vector<Eigen::Matrix3Xd>& samples) const {
    // Starts in the steady state of the first sample, so that a constant passes unchanged.
    Eigen::Matrix3Xd x1 = samples[0], x2 = samples[0], y1 = samples[0], y2 = samples[0];
    for (Eigen::Matrix3Xd& sample : samples) {
      const Eigen::Matrix3Xd x = sample;
      sample = b0 * x + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = sample;
    }
  }
};

Biquad ButterworthLowPass(double cutoff, double fps) {
  const double k = std::tan(std::numbers::pi * cutoff / fps);
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
  const double b0 = k * k * norm;
  return {b0, 2 * b0, b0, 2 * (k * k - 1) * norm, (1 - std::numbers::sqrt2 * k + k * k) * norm};
}

}  // namespace

void CheckClip(const PositionClip& clip) {
  if (!(clip.fps > 0) || !std::isfinite(clip.fps)) {
    throw InvalidArgument("clip.fps", std::to_string(clip.fps) + ", must be above 0");
  }
  if (clip.frames.empty()) throw InvalidArgument("clip.frames", "0 frames, at least 1 is needed");
  for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
    const std::string field = "clip.frames[" + std::to_string(frame) + "]";
    if (clip.frames[frame].cols() != static_cast<Eigen::Index>(clip.joint_names.size())) {
      throw InvalidArgument(field, std::to_string(clip.frames[frame].cols()) + " joints, must be " +
                                       std::to_string(clip.joint_names.size()));
    }
    if (!clip.frames[frame].allFinite()) throw InvalidArgument(field, "not finite");
  }
}

PositionClip LowPass(const PositionClip& clip, double cutoff_hz) {
  const auto count = static_cast<int>(clip.frames.size());
  // Two passes quarter the power at a pass's own cutoff; raise it so that both together halve it at
  // cutoff_hz.
  const double pass_cutoff = cutoff_hz / std::pow(std::numbers::sqrt2 - 1.0, 0.25);
  if (pass_cutoff >= 0.49 * clip.fps || count < 3) return clip;
  const int margin = std::min(count - 1, static_cast<int>(std::ceil(2 * clip.fps / cutoff_hz)));
  std::vector<Eigen::Matrix3Xd> samples;
  for (int i = margin; i >= 1; --i) samples.emplace_back(2 * clip.frames[0] - clip.frames[i]);
  samples.insert(samples.end(), clip.frames.begin(), clip.frames.end());
  for (int i = 1; i <= margin; ++i) {
    samples.emplace_back(2 * clip.frames[count - 1] - clip.frames[count - 1 - i]);
  }
  const Biquad filter = ButterworthLowPass(pass_cutoff, clip.fps);
  filter.Run(samples);
  std::ranges::reverse(samples);
  filter.Run(samples);
  return {clip.fps, clip.joint_names, {samples.rbegin() + margin, samples.rend() - margin}};
}

PositionClip ResamplePositions(const PositionClip& clip, double fps, double time_scale) {
  if (!(time_scale > 0)) {
    throw InvalidArgument("time_scale", std::to_string(time_scale) + ", must be above 0");
  }
  const auto last = static_cast<int>(clip.frames.size()) - 1;
  const double duration = last / clip.fps * time_scale;
  const auto count = static_cast<int>(std::floor(duration * fps + kOnFrame)) + 1;
  PositionClip result{.fps = fps, .joint_names = clip.joint_names, .frames = {}};
  for (int i = 0; i < count; ++i) {
    const double position =
        std::clamp(i / fps / time_scale * clip.fps, 0.0, static_cast<double>(last));
    const int frame = std::min(static_cast<int>(position), std::max(0, last - 1));
    const double t = position - frame;
    const Eigen::Matrix3Xd& p0 = clip.frames[std::max(frame - 1, 0)];
    const Eigen::Matrix3Xd& p1 = clip.frames[frame];
    const Eigen::Matrix3Xd& p2 = clip.frames[std::min(frame + 1, last)];
    const Eigen::Matrix3Xd& p3 = clip.frames[std::min(frame + 2, last)];
    result.frames.emplace_back(p1 + 0.5 * t *
                                        ((p2 - p0) + t * ((2 * p0 - 5 * p1 + 4 * p2 - p3) +
                                                          t * (3 * (p1 - p2) + p3 - p0))));
  }
  return result;
}

int RemoveSpikes(double speed_limit, int max_frames, PositionClip& clip) {
  const auto count = static_cast<int>(clip.frames.size());
  const double step_limit = speed_limit / clip.fps;
  int replaced = 0;
  for (Eigen::Index joint = 0; joint < clip.frames[0].cols(); ++joint) {
    for (int frame = 1; frame < count; ++frame) {
      const Eigen::Vector3d before = clip.frames[frame - 1].col(joint);
      if ((clip.frames[frame].col(joint) - before).norm() <= step_limit) continue;
      // The spike ends at the first frame that the joint could reach at a plausible speed. If there
      // is none, it is a jump.
      int good = frame + 1;
      const int end = std::min(count, frame + max_frames + 1);
      while (good < end &&
             (clip.frames[good].col(joint) - before).norm() > step_limit * (good - frame + 1)) {
        ++good;
      }
      if (good >= end) continue;
      const Eigen::Vector3d after = clip.frames[good].col(joint);
      for (int i = frame; i < good; ++i) {
        const double t = static_cast<double>(i - frame + 1) / (good - frame + 1);
        clip.frames[i].col(joint) = before + t * (after - before);
        ++replaced;
      }
    }
  }
  return replaced;
}

}  // namespace choreo
