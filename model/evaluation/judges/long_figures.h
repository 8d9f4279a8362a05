#pragma once

#include <span>
#include <vector>

#include "model/evaluation/windows.h"
#include "model/metrics/groove.h"
#include "model/metrics/joint_track.h"
#include "model/plan/sampler.h"

namespace choreo {

/// Measures a long dance for drift (our own bounds), freezing, explosion, broken limbs and jolts at
/// its keys.
struct LongFigures {
  double seconds = 0;
  double median_speed = 0;  ///< of the mean joint speed, m/s
  double late_speed = 0;    ///< the same over the last fifth: shows freezing
  double stillest = 0;   ///< the least median over any fifth, tried at every fiftieth of the dance
  double top_speed = 0;  ///< the fastest frame's: shows explosion
  double reach_m = 0;    ///< largest distance of the root from its start, on the floor
  /// Slope of the least-squares line through the root's floor distance from its start, metres per
  /// minute: positive if the dancer walks away, near 0 if it comes back or stays.
  double away_m_per_min = 0;
  /// Mean height of the root over the last 10 s minus that over the first (halves below 20 s), m.
  double rise_m = 0;
  double pace_change = 1;              ///< ratio of mean joint speeds: the last 10 s over the first
  double lowest_m = 0, highest_m = 0;  ///< heights of the root
  /// Share of (frame, hinge) pairs with a knee or elbow bent more than 15 degrees beyond straight.
  double bent_backwards = 0;
  Snaps snaps;
  std::vector<double> joint_speeds;              ///< [joints] medians, m/s
  std::vector<float> speeds;                     ///< mean joint speed step by step, m/s
  double skate_ratio = 0, p95_acceleration = 0;  ///< quality_report.h
  std::vector<float> key_accelerations;  ///< m/s^2, the largest within two frames of each key
};

/// `key_frames`: ascending.
LongFigures MeasureLong(const Skeleton& skeleton, double fps, std::span<const Pose> poses,
                        const std::vector<int>& key_frames);

/// The ranges of a set's real motion.
struct RealRange {
  std::vector<double> low, high;  ///< [joints] 5th and 95th percentile of each joint's speed, m/s
  double median_speed = 0;        ///< of the mean joint speed, over all frames
  double top_speed = 0;
  double p95_acceleration = 0;  ///< mean over clips
  /// The most that any clip moves away, rises or sinks, and changes pace (as a factor of at least
  /// 1). At least 3 m/min (5 cm/s), 0.15 m and 2, because a set may have only a few calm clips.
  double away_m_per_min = 3, rise_m = 0.15, pace_change = 2;

  /// Whether a dance whose last fifth has this speed is frozen: slower than a quarter of real
  /// motion. A dance that pauses in its middle but moves at its end is not frozen; only
  /// LongFigures::stillest shows the pause.
  bool Frozen(double speed) const { return speed < 0.25 * median_speed; }
  bool Frozen(const LongFigures& dance) const { return Frozen(dance.late_speed); }
  bool Exploded(const LongFigures& dance) const { return dance.top_speed > top_speed; }
  /// Whether a dance leaves its place, height or pace by more than real motion does.
  bool Drifted(const LongFigures& dance) const;
  /// The share of joints whose median speed is between low and high.
  double JointsWithin(const LongFigures& dance) const;
};

/// `real`: figures of the clips `tracks`, one each.
RealRange RangeOf(const std::vector<LongFigures>& real, const std::vector<JointTrack>& tracks,
                  double fps);

/// A set's clips, measured as dances with keys at their own frames every 2 s, and their ranges.
struct RealDances {
  std::vector<LongFigures> clips;
  RealRange range;
};
RealDances MeasureReal(const ClipSet& set, const ModelInfo& model);

}  // namespace choreo
