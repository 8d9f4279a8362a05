#pragma once

#include <span>
#include <vector>

#include "model/engine/sampler.h"
#include "model/evaluation/windows.h"
#include "model/metrics/groove.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// A long dance judged for drift (our own bounds), freezing, explosion, broken limbs and jolts at
/// its keys.
struct LongFigures {
  double seconds = 0;
  double median_speed = 0;  ///< of the mean joint speed, m/s
  double late_speed = 0;    ///< the same over its last fifth: freezing shows here
  double stillest = 0;   ///< the least that it is over any fifth, tried each fiftieth of the dance
  double top_speed = 0;  ///< of any frame: explosion shows here
  double reach_m = 0;    ///< furthest that the root goes from its start, on the floor
  /// Slope of the least-squares line through the root's distance from its start on the floor,
  /// metres a minute: above zero for who walks away, near it for who comes back or stays.
  double away_m_per_min = 0;
  /// Mean height of the root over the last 10 s less that over the first (halves of what is shorter
  /// than 20 s), m.
  double rise_m = 0;
  double pace_change = 1;  ///< mean joint speed over the last 10 s over that over the first
  double lowest_m = 0, highest_m = 0;  ///< heights of the root
  /// Share of (frame, hinge) pairs in which a knee or elbow is bent more than 15 degrees beyond
  /// straight.
  double bent_backwards = 0;
  Snaps snaps;
  std::vector<double> joint_speeds;              ///< [joints] medians, m/s
  std::vector<float> speeds;                     ///< mean joint speed step by step, m/s
  double skate_ratio = 0, p95_acceleration = 0;  ///< quality_report.h
  std::vector<float> key_accelerations;          ///< m/s^2, each key's within two frames
};

/// `key_frames`: ascending.
LongFigures MeasureLong(const Skeleton& skeleton, double fps, std::span<const Pose> poses,
                        const std::vector<int>& key_frames);

/// What real motion of a set allows.
struct RealRange {
  std::vector<double> low, high;  ///< [joints] 5th and 95th percentile of its speeds, m/s
  double median_speed = 0;        ///< of the mean joint speed, over all frames
  double top_speed = 0;
  double p95_acceleration = 0;  ///< mean over clips
  /// The most that any of its clips goes away, rises or sinks, and gains or loses pace (as a factor
  /// above 1); at least 3 m/min (five centimetres a second), 0.15 m and 2, for sets of few calm
  /// clips.
  double away_m_per_min = 3, rise_m = 0.15, pace_change = 2;

  /// A dance whose last fifth is slower than a quarter of real motion has frozen. One that stands
  /// in its middle and moves again at its end has not: that shows in LongFigures::stillest alone.
  bool Frozen(double speed) const { return speed < 0.25 * median_speed; }
  bool Frozen(const LongFigures& dance) const { return Frozen(dance.late_speed); }
  bool Exploded(const LongFigures& dance) const { return dance.top_speed > top_speed; }
  /// It leaves its place, its height or its pace by more than real motion does.
  bool Drifted(const LongFigures& dance) const;
  /// Share of the joints whose median speed lies within low and high.
  double JointsWithin(const LongFigures& dance) const;
};

/// `real`: figures of the clips `tracks`, one each.
RealRange RangeOf(const std::vector<LongFigures>& real, const std::vector<JointTrack>& tracks,
                  double fps);

/// The clips of a set as dances whose keys are their frames each 2 s, and what they allow.
struct RealDances {
  std::vector<LongFigures> clips;
  RealRange range;
};
RealDances MeasureReal(const ClipSet& set, const ModelInfo& model);

}  // namespace choreo
