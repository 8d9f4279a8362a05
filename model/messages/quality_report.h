#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/messages/dance_event.h"

namespace choreo {

/// The speed of a body part (VelocityFactors), metres a frame.
struct PartSpeed {
  double asked = 0;
  double danced = 0;
};

/// How to rank candidates: by steering, support and skating, or by likelihood alone, if the model
/// has one.
enum class RankBy { kQuality, kLikelihood };

/// Figures of quality of a dance. All at the model's rate, before resampling for output.
struct QualityReport {
  int64_t frames = 0;
  std::vector<KeyReached> keys = {};
  int64_t measured_from = 0;  ///< the first frame that the figures below cover
  /// Log-likelihood of the model's own frames, nats a frame, in its standardised space; absent if
  /// the model has no exact likelihood.
  std::optional<double> log_likelihood = {};
  /// Share of the steps (pairs of successive frames) in which either foot skates: its toe joint is
  /// below 5 cm in both frames and moves faster than 0.2 m/s over the floor.
  double skate_ratio = 0;
  /// Share of the frames in which something supports the body (Balance::Supported). Absent for a
  /// skeleton whose mass is unknown.
  std::optional<double> support = {};
  /// Paper F, 4.5.1: the share of kinematic beats (KinematicBeats) with a music beat at most two
  /// frames away. Absent if there are no music beats or no kinematic beats.
  std::optional<double> beat_hit_rate = {};
  /// Kinematic beats / music beats, over the dance's frames. Absent without music beats.
  std::optional<double> beat_coverage = {};
  double max_key_acceleration = 0;  ///< over all keys, m/s^2
  /// 95th percentile over the frames of the largest joint acceleration, m/s^2; compare
  /// max_key_acceleration with it.
  double p95_acceleration = 0;
  double max_acceleration =
      0;  ///< the largest of any frame and joint, m/s^2; servers do not send it
  /// Means by BodyPart over the frames with velocity factors; empty without any.
  std::vector<PartSpeed> part_speeds = {};
};

}  // namespace choreo
