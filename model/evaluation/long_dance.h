#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/training/prepared_clip.h"

/// How good a model's dances are, through the same engine and dance/ as they are served with.
namespace choreo {

/// A long dance judged for drift, freezing, explosion and broken limbs.
struct LongDanceRow {
  int frames = 0;
  bool finite = true;
  double median_speed = 0;             ///< of the mean joint speed, m/s, over the dance
  double late_speed = 0;               ///< the same over its last fifth: freezing shows here
  double root_reach_m = 0;             ///< furthest horizontal distance from the start
  double lowest_m = 0, highest_m = 0;  ///< height of the root over the dance
  /// Share of (frame, hinge) pairs in which a knee or elbow is bent more than 15 degrees beyond
  /// straight.
  double bent_backwards = 0;
  /// Share of joints whose median speed lies within the 5th to 95th percentile of the same joint's
  /// speeds in real motion.
  double joints_in_real_speed = 0;
  double worst_key_m = 0;  ///< final error of the worst key; 0 without keys
};

/// Speeds of real motion, the yardstick for a dance's: per joint percentiles over all frames of the
/// clips, m/s.
struct SpeedRange {
  std::vector<double> low, high;  ///< [joints] 5th and 95th percentile
  double median = 0;              ///< of the mean joint speed
  double bent_backwards = 0;      ///< the fit's own share
};
SpeedRange MeasureRealSpeeds(const std::vector<PreparedClip>& clips);

/// Dances `frames` frames from a real history of `clip` without music; keys are poses of the clip
/// itself, taken every `key_interval` frames (0: no keys, transitions of 60 frames without a
/// target).
LongDanceRow EvaluateLongDance(StepEngine& engine, const PreparedClip& clip, int frames,
                               int key_interval, float temperature, uint64_t seed,
                               const SpeedRange& real);

}  // namespace choreo
