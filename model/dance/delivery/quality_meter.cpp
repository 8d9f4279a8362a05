#include "model/dance/delivery/quality_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "model/audio/beats/beats.h"
#include "model/core/error.h"
#include "model/core/numbers/quantile.h"
#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/motion_faults.h"

namespace choreo {
namespace {

constexpr double kToeHeight = 0.05;  // metres
constexpr int64_t kFramesAroundKey = 2;

}  // namespace

QualityMeter::QualityMeter(const Skeleton& skeleton, double fps, int64_t first_frame,
                           std::vector<KeyReached> reached)
    : skeleton_(skeleton), fps_(fps), first_frame_(first_frame), keys_(std::move(reached)) {
  if (skeleton.feet[1] < 0 || skeleton.feet[3] < 0) {
    throw InvalidArgument("skeleton", skeleton.Describe() + ": it has no toes");
  }
  if (BalanceGauge::Fits(skeleton)) support_.emplace(skeleton, fps);
}

void QualityMeter::Add(const DanceFrame& frame) {
  if (log_likelihood_sum_ && frame.log_likelihood) {
    *log_likelihood_sum_ += *frame.log_likelihood;
  } else {
    log_likelihood_sum_.reset();
  }
  ++frames_;
  Eigen::Matrix3Xd now = JointPositions(skeleton_, frame.pose);
  if (support_) support_->Add(now);
  if (!last_positions_.empty()) {
    const Eigen::Matrix3Xd& before = last_positions_.back();
    const Eigen::Matrix3Xd step = now - before;
    if (frame.asked_speeds) AddSpeeds(*frame.asked_speeds, before, now);
    speed_.push_back(static_cast<float>(step.colwise().norm().mean() * fps_));
    bool skates = false;
    for (int toe : {skeleton_.feet[1], skeleton_.feet[3]}) {
      const bool low = now(1, toe) < kToeHeight && before(1, toe) < kToeHeight;
      skates = skates || (low && std::hypot(step(0, toe), step(2, toe)) * fps_ > kSkateSpeed);
    }
    if (skates) ++skating_steps_;
    if (last_positions_.size() == 2) {
      const Eigen::Matrix3Xd bend = step - (before - last_positions_.front());
      acceleration_.push_back(static_cast<float>(bend.colwise().norm().maxCoeff() * fps_ * fps_));
      last_positions_.pop_front();
    }
  }
  last_positions_.push_back(std::move(now));
}

void QualityMeter::AddSpeeds(const std::array<float, kBodyParts>& asked,
                             const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now) {
  if (!weights_) weights_ = WeighBodyParts(skeleton_);
  const std::array<double, kBodyParts> danced = PartSpeeds(*weights_, before, now);
  for (size_t part = 0; part < kBodyParts; ++part) {
    speed_sums_[part].asked += asked[part];
    speed_sums_[part].danced += danced[part];
  }
  ++speed_frames_;
}

void QualityMeter::AddKey(KeyReached key) {
  key.frame = first_frame_ + frames_ - 1;
  keys_.push_back(std::move(key));
}

QualityReport QualityMeter::Report(std::span<const double> music_beats) const {
  QualityReport report;
  report.measured_from = first_frame_;
  report.frames = frames_;
  report.keys = keys_;
  if (frames_ > 0 && log_likelihood_sum_)
    report.log_likelihood = *log_likelihood_sum_ / static_cast<double>(frames_);
  if (!speed_.empty()) {
    report.skate_ratio = static_cast<double>(skating_steps_) / static_cast<double>(speed_.size());
  }
  if (support_) report.support = support_->Share();
  for (KeyReached& key : report.keys) {
    // acceleration_[i] belongs to frame i + 1.
    const int64_t middle = key.frame - first_frame_ - 1;
    const int64_t last = static_cast<int64_t>(acceleration_.size()) - 1;
    for (int64_t i = std::max<int64_t>(0, middle - kFramesAroundKey);
         i <= std::min(last, middle + kFramesAroundKey); ++i) {
      key.max_acceleration =
          std::max<double>(key.max_acceleration, acceleration_[static_cast<size_t>(i)]);
    }
    report.max_key_acceleration = std::max(report.max_key_acceleration, key.max_acceleration);
  }
  if (!acceleration_.empty()) {
    report.p95_acceleration = Percentile(acceleration_, 0.95);
    report.max_acceleration = *std::ranges::max_element(acceleration_);
  }

  if (speed_frames_ > 0) {
    const auto frames = static_cast<double>(speed_frames_);
    report.part_speeds = {speed_sums_.begin(), speed_sums_.end()};
    for (PartSpeed& part : report.part_speeds) part.asked /= frames, part.danced /= frames;
  }

  std::vector<double> beats;
  for (double beat : music_beats) {
    const double frame = beat * fps_ - static_cast<double>(first_frame_);
    if (frame >= 0 && frame < static_cast<double>(frames_)) beats.push_back(frame);
  }
  if (beats.empty()) return report;
  const std::vector<int64_t> kinematic = KinematicBeats(speed_, fps_);
  report.beat_coverage = static_cast<double>(kinematic.size()) / static_cast<double>(beats.size());
  if (kinematic.empty()) return report;
  const auto hits = std::count_if(kinematic.begin(), kinematic.end(), [&beats](int64_t frame) {
    return std::any_of(beats.begin(), beats.end(), [frame](double beat) {
      return std::abs(beat - static_cast<double>(frame)) <= kBeatGap;
    });
  });
  report.beat_hit_rate = static_cast<double>(hits) / static_cast<double>(kinematic.size());
  return report;
}

QualityReport MeasureMotion(const Skeleton& skeleton, const Motion& motion) {
  QualityMeter meter(skeleton, motion.fps, 0);
  for (const Pose& pose : motion.frames) meter.Add({.pose = pose});
  return meter.Report();
}

}  // namespace choreo
