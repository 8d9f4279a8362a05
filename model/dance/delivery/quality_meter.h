#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/transition/transition.h"
#include "model/messages/quality_report.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/floor/support.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Computes a QualityReport from frames added in order. Stores a few numbers per frame. Not
/// thread-safe.
class QualityMeter {
 public:
  /// `reached`: keys reached before the first frame.
  QualityMeter(const Skeleton& skeleton, double fps, int64_t first_frame,
               std::vector<KeyReached> reached = {});

  void Add(const DanceFrame& frame);
  /// Adds the key reached at the last added frame.
  void AddKey(KeyReached key);
  /// All keys so far, without the accelerations around each.
  const std::vector<KeyReached>& keys() const { return keys_; }
  /// The report on all frames so far. `music_beats`: seconds, ascending; if empty, the report has
  /// no beat figures. Beats outside the dance do not count.
  QualityReport Report(std::span<const double> music_beats = {}) const;

 private:
  void AddSpeeds(const std::array<float, kBodyParts>& asked, const Eigen::Matrix3Xd& before,
                 const Eigen::Matrix3Xd& now);

  Skeleton skeleton_;
  double fps_;
  int64_t first_frame_;
  std::vector<KeyReached> keys_;
  std::optional<double> log_likelihood_sum_ = 0;  // none after a frame without a likelihood
  int64_t skating_steps_ = 0;
  std::optional<SupportMeter> support_;
  std::deque<Eigen::Matrix3Xd> last_positions_;  // [3, joints] of the last two frames
  std::vector<float> speed_;         // mean joint speed of step i (frame i -> i + 1), m/s
  std::vector<float> acceleration_;  // largest joint acceleration at frame i + 1, m/s^2
  int64_t frames_ = 0;
  std::optional<BodyPartWeights> weights_;  // set once a frame has requested speeds
  std::array<PartSpeed, kBodyParts> speed_sums_ = {};
  int64_t speed_frames_ = 0;
};

/// Measures a whole motion, for evaluation, without contacts, likelihood and beats.
QualityReport MeasureMotion(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
