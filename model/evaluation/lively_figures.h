#pragma once

#include <vector>

#include "model/evaluation/long_plans.h"
#include "model/metrics/groove.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// The liveliness of a dance through keys.
struct LivelyFigures {
  size_t clip = 0;          ///< index in its set
  double median_speed = 0;  ///< over frames, of the mean joint speed, m/s
  LimbTravel limbs;
  double bounce = 0;                       ///< PelvisBounce, m
  double jerk = 0, raw_jerk = 0;           ///< SmoothJerk, RawJerk, m/s^3
  double skate_ratio = 0;                  ///< quality_report.h
  double kinematic_beats = 0;              ///< a minute
  double knee_snaps = 0, elbow_snaps = 0;  ///< CountSnaps, a minute
  JointTrack track;                        ///< from the pose before the first frame on
  std::vector<float> speeds;               ///< mean joint speed of each frame, m/s
  std::vector<double> turns;               ///< WindowTurns, from that pose on
  double faces_away = 0;                   ///< FacesAway, from where that pose faces
};

/// `poses`: the dance of this plan, or a replacement.
LivelyFigures MeasureLiveliness(const ModelInfo& model, const LongPlan& plan,
                                const std::vector<Pose>& poses);

using LivelyDances = std::vector<LivelyFigures>;

/// Hit rate (ScoreBeats) minus the same dance's hit rate by chance: the mean over these beats moved
/// by each fraction of their distance, a frame apart. Percentage points.
Cell HitsOverChance(const LivelyDances& dances, double bpm, double phase, double fps);

}  // namespace choreo
