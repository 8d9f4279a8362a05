#include "model/evaluation/judges/long_figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/core/grid.h"
#include "model/dance/delivery/quality_meter.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Speeds of one joint, m/s, appended.
void AddJointSpeeds(const JointTrack& track, Eigen::Index joint, double fps,
                    std::vector<float>* speeds) {
  for (size_t t = 1; t < track.size(); ++t) {
    speeds->push_back(
        static_cast<float>((track[t].col(joint) - track[t - 1].col(joint)).norm() * fps));
  }
}

// The slope of the least-squares line through values at 0, 1, 2, ...
double Slope(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double middle = (count - 1) / 2;
  double covariance = 0, variance = 0;
  for (size_t t = 0; t < values.size(); ++t) {
    const double from_middle = static_cast<double>(t) - middle;
    covariance += from_middle * values[t];
    variance += from_middle * from_middle;
  }
  return variance > 0 ? covariance / variance : 0;
}

// Means of the first and the last `length` values, or of the two halves if there are fewer.
template <typename Value>
std::pair<double, double> MeansOfEnds(const std::vector<Value>& values, size_t length) {
  length = std::min(length, values.size() / 2);
  if (length == 0) return {0, 0};
  const auto part = static_cast<std::ptrdiff_t>(length);
  const auto mean = [&](auto from, auto to) { return std::accumulate(from, to, 0.0) / length; };
  return {mean(values.begin(), values.begin() + part), mean(values.end() - part, values.end())};
}

// The least median of `length` consecutive values; 0 for none.
double LeastMedian(const std::vector<float>& values, size_t length) {
  if (length == 0) return 0;
  double least = INFINITY;
  const size_t last = values.size() - length;
  const size_t step = std::max<size_t>(1, length / 10);
  for (size_t tried = 0; tried < last + step; tried += step) {
    const auto from = values.begin() + std::min(tried, last);
    least = std::min(least, Percentile({from, from + static_cast<std::ptrdiff_t>(length)}, 0.5));
  }
  return least;
}

// The change of pace as a factor of at least 1, faster or slower.
double PaceFactor(const LongFigures& dance) {
  return std::max(dance.pace_change, 1 / dance.pace_change);
}

}  // namespace

LongFigures MeasureLong(const Skeleton& skeleton, double fps, std::span<const Pose> poses,
                        const std::vector<int>& key_frames) {
  LongFigures figures;
  if (poses.empty()) return figures;
  figures.seconds = static_cast<double>(poses.size()) / fps;
  QualityMeter meter(skeleton, fps, 0);
  const std::vector<Hinge> hinges = Hinges(skeleton);
  int64_t backwards = 0;
  const Eigen::Vector3d start = poses[0].root_position;
  std::vector<double> away, heights;
  for (size_t t = 0; t < poses.size(); ++t) {
    meter.Add({.pose = poses[t]});
    if (std::ranges::binary_search(key_frames, static_cast<int>(t))) meter.AddKey({});
    const Eigen::Vector3d& root = poses[t].root_position;
    away.push_back(std::hypot(root.x() - start.x(), root.z() - start.z()));
    heights.push_back(root.y());
    backwards += std::ranges::count_if(hinges, [&](const Hinge& hinge) {
      return hinge.axis.dot(poses[t].rotations.col(hinge.joint)) < -kBrokenBackwards / kDegrees;
    });
  }
  figures.lowest_m = std::ranges::min(heights);
  figures.highest_m = std::ranges::max(heights);
  figures.reach_m = std::ranges::max(away);
  figures.away_m_per_min = Slope(away) * fps * 60;
  const auto ten_seconds = static_cast<size_t>(std::lround(10 * fps));
  const auto [low, high] = MeansOfEnds(heights, ten_seconds);
  figures.rise_m = high - low;
  const auto pairs = static_cast<double>(poses.size() * hinges.size());
  figures.bent_backwards = pairs > 0 ? static_cast<double>(backwards) / pairs : 0;
  const QualityReport report = meter.Report();
  figures.skate_ratio = report.skate_ratio;
  figures.p95_acceleration = report.p95_acceleration;
  for (const KeyReached& one : report.keys)
    figures.key_accelerations.push_back(static_cast<float>(one.max_acceleration));
  const JointTrack track = TrackJoints(skeleton, poses);
  figures.snaps = CountSnaps(skeleton, fps, track);
  figures.speeds = MeanSpeeds(track, fps);
  const auto [early, late] = MeansOfEnds(figures.speeds, ten_seconds);
  if (early > 0) figures.pace_change = late / early;
  figures.median_speed = Percentile(figures.speeds, 0.5);
  figures.top_speed = Percentile(figures.speeds, 1);
  const size_t fifth = figures.speeds.size() / 5;
  figures.late_speed = Percentile(
      {figures.speeds.end() - static_cast<std::ptrdiff_t>(fifth), figures.speeds.end()}, 0.5);
  figures.stillest = LeastMedian(figures.speeds, fifth);
  for (Eigen::Index joint = 0; joint < skeleton.joints(); ++joint) {
    std::vector<float> speeds;
    AddJointSpeeds(track, joint, fps, &speeds);
    figures.joint_speeds.push_back(Percentile(std::move(speeds), 0.5));
  }
  return figures;
}

bool RealRange::Drifted(const LongFigures& dance) const {
  return dance.away_m_per_min > away_m_per_min || std::abs(dance.rise_m) > rise_m ||
         PaceFactor(dance) > pace_change;
}

double RealRange::JointsWithin(const LongFigures& dance) const {
  int within = 0;
  for (size_t joint = 0; joint < low.size(); ++joint) {
    const double speed = dance.joint_speeds[joint];
    if (speed >= low[joint] && speed <= high[joint]) ++within;
  }
  return low.empty() ? 0 : static_cast<double>(within) / low.size();
}

RealRange RangeOf(const std::vector<LongFigures>& real, const std::vector<JointTrack>& tracks,
                  double fps) {
  RealRange range;
  std::vector<float> means;
  for (const LongFigures& clip : real) {
    means.insert(means.end(), clip.speeds.begin(), clip.speeds.end());
    range.top_speed = std::max(range.top_speed, clip.top_speed);
    range.away_m_per_min = std::max(range.away_m_per_min, clip.away_m_per_min);
    range.rise_m = std::max(range.rise_m, std::abs(clip.rise_m));
    range.pace_change = std::max(range.pace_change, PaceFactor(clip));
    range.p95_acceleration += clip.p95_acceleration / real.size();
  }
  range.median_speed = Percentile(std::move(means), 0.5);
  const Eigen::Index joints = tracks.empty() ? 0 : tracks[0].at(0).cols();
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    std::vector<float> speeds;
    for (const JointTrack& track : tracks) AddJointSpeeds(track, joint, fps, &speeds);
    range.low.push_back(Percentile(speeds, 0.05));
    range.high.push_back(Percentile(std::move(speeds), 0.95));
  }
  return range;
}

RealDances MeasureReal(const ClipSet& set, const ModelInfo& model) {
  RealDances real;
  std::vector<JointTrack> tracks;
  for (const PreparedClip& clip : set.clips) {
    std::vector<int> keys;
    for (int f = kTypicalFrames - 1; f < static_cast<int>(clip.motion.frames.size());
         f += kTypicalFrames)
      keys.push_back(f);
    real.clips.push_back(MeasureLong(model.skeleton, model.fps, clip.motion.frames, keys));
    tracks.push_back(TrackJoints(model.skeleton, clip.motion.frames));
  }
  real.range = RangeOf(real.clips, tracks, model.fps);
  return real;
}

}  // namespace choreo
