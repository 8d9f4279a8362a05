#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/dance/transition.h"
#include "model/motion/skeleton.h"
#include "model/motion/support.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// One key of the report.
struct KeyReport {
  std::string id;
  int64_t frame = 0;
  ArrivalResult arrival;
  /// Largest joint acceleration (m/s^2) of the frames within two of the key's; less where the dance
  /// ends earlier.
  double max_acceleration = 0;
};

/// How fast a part of the body is (VelocityFactors), metres a frame.
struct PartSpeed {
  double asked = 0;
  double danced = 0;
};

/// What a dance is worth, in figures. All at the model's rate, before resampling for output.
struct QualityReport {
  int64_t first_frame = 0;
  int64_t frames = 0;
  std::vector<KeyReport> keys;
  /// Of what the model proposed, nats a frame, in its own standardised space; absent where a model
  /// has no exact likelihood.
  std::optional<double> mean_log_likelihood;
  /// Share of the steps (pairs of successive frames) in which either foot skates: its toe joint is
  /// below 5 cm in both frames and moves faster than 0.2 m/s over the floor.
  double skate_ratio = 0;
  /// Share of the frames in which something bears the body (Balance::Supported). Absent for a
  /// skeleton whose mass is unknown.
  std::optional<double> support;
  /// Paper F, 4.5.1: of the kinematic beats (KinematicBeats), the share with a music beat at most
  /// two frames away. Absent without music beats, or without kinematic ones.
  std::optional<double> beat_hit_rate;
  std::optional<double> beat_coverage;  ///< kinematic beats / music beats, over the dance's frames
  double max_key_acceleration = 0;      ///< over all keys, m/s^2
  /// 95th percentile over the frames of the largest joint acceleration, m/s^2: what to hold
  /// max_key_acceleration against.
  double p95_acceleration = 0;
  double max_acceleration = 0;  ///< the largest of any frame and joint, m/s^2
  /// By BodyPart, means over the frames of which velocity factors asked something; absent without.
  std::optional<std::array<PartSpeed, kBodyParts>> part_speeds;
};

/// Gathers a QualityReport while a dance goes by, in a few numbers a frame. Frames come in order.
/// Not thread-safe.
class QualityMeter {
 public:
  QualityMeter(const Skeleton& skeleton, double fps, int64_t first_frame);

  void Add(const DanceFrame& frame);
  /// The key at the frame that was added last.
  void AddKey(std::string id, const ArrivalResult& arrival);
  /// `music_beats`: seconds, ascending; empty: no beat figures. Those outside the dance do not
  /// count.
  QualityReport Report(std::span<const double> music_beats = {}) const;

 private:
  void AddSpeeds(const std::array<float, kBodyParts>& asked, const Eigen::Matrix3Xd& before,
                 const Eigen::Matrix3Xd& now);

  Skeleton skeleton_;
  double fps_;
  int64_t first_frame_;
  std::vector<KeyReport> keys_;
  std::optional<double> log_likelihood_sum_ = 0;  // none once a frame came without
  int64_t skating_steps_ = 0;
  std::optional<SupportMeter> support_;
  std::deque<Eigen::Matrix3Xd> last_positions_;  // [3, joints] of the last two frames
  std::vector<float> speed_;         // mean joint speed of step i (frame i -> i + 1), m/s
  std::vector<float> acceleration_;  // largest joint acceleration at frame i + 1, m/s^2
  int64_t frames_ = 0;
  std::optional<BodyPartWeights> weights_;  // once a frame has asked speeds
  std::array<PartSpeed, kBodyParts> speed_sums_ = {};
  int64_t speed_frames_ = 0;
};

/// Shorthand for whole motions (evaluation). Contacts, likelihood and beats are not judged.
QualityReport MeasureMotion(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
