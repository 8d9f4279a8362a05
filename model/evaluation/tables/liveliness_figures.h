#pragma once

#include <vector>

#include "model/evaluation/judges/long_plans.h"
#include "model/metrics/groove.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// The liveliness of a dance through keys.
struct LivelinessFigures {
  size_t clip = 0;          ///< index in its set
  double median_speed = 0;  ///< median over frames of the mean joint speed, m/s
  LimbTravel limbs;
  double bounce = 0;                       ///< PelvisBounce, m
  double jerk = 0, raw_jerk = 0;           ///< SmoothJerk, RawJerk, m/s^3
  double skate_ratio = 0;                  ///< quality_report.h
  double kinematic_beats = 0;              ///< per minute
  double knee_snaps = 0, elbow_snaps = 0;  ///< CountSnaps, per minute
  double arms_inside = 0;                  ///< share of frames (MotionFaultKind::kArmInside)
  JointTrack track;                        ///< begins with the pose before the first frame
  std::vector<float> speeds;               ///< mean joint speed of each frame, m/s
  std::vector<double> turns;               ///< WindowTurns, from that pose on
  double faces_away = 0;                   ///< FacesAway, relative to that pose's heading
};

/// Measures a dance. `poses`: the plan's dance, or a replacement.
LivelinessFigures MeasureLiveliness(const ModelInfo& model, const LongPlan& plan,
                                    const std::vector<Pose>& poses);

using LivelinessDances = std::vector<LivelinessFigures>;

/// The hit rate (ScoreBeats) minus the hit rate by chance, in percentage points. Chance is the same
/// dance's mean hit rate when the beats are shifted by 1, 2, ... frames, up to their distance.
Cell HitsOverChance(const LivelinessDances& dances, double bpm, double phase, double fps);

}  // namespace choreo
