#include "model/dance/delivery/body_watch.h"

#include <utility>

#include "model/dance/timeline/warning.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/body_limits.h"

namespace choreo {

BodyWatch::BodyWatch(const Skeleton& skeleton, double fps, const std::optional<Pose>& before)
    : skeleton_(skeleton), fps_(fps), clearance_(FloorClearance(skeleton)) {
  if (before) last_ = JointPositions(skeleton, *before);
}

void BodyWatch::StartTransition(const std::string& key_id, int64_t frames) {
  key_id_ = key_id;
  frames_ = frames;
  fastest_ = {};
}

void BodyWatch::Add(int64_t frame, const Pose& pose) {
  Eigen::Matrix3Xd now = JointPositions(skeleton_, pose);
  if (last_) {
    Eigen::Index joint = 0;
    const double m_per_s = (now - *last_).colwise().norm().maxCoeff(&joint) * fps_;
    if (m_per_s > fastest_.m_per_s) fastest_ = {m_per_s, joint, frame};
  }
  WatchFlight(frame, now);
  last_ = std::move(now);
}

void BodyWatch::WatchFlight(int64_t frame, const Eigen::Matrix3Xd& joints) {
  if ((joints.row(1) - clearance_).minCoeff() > kUpHeight) {
    if (!aloft_from_) aloft_from_ = frame;
    ++aloft_;
    return;
  }
  WarnOfFlight(aloft_);
  aloft_from_.reset();
  aloft_ = 0;
  told_ = false;
}

void BodyWatch::WarnOfFlight(int64_t frames) {
  const double seconds = static_cast<double>(frames) / fps_;
  if (told_ || seconds <= kLongestFlight) return;
  told_ = true;
  flights_.push_back(FlightTooLong(*aloft_from_, seconds, key_id_));
}

std::vector<Warning> BodyWatch::TakeWarnings() {
  std::vector<Warning> warnings;
  if (fastest_.m_per_s > kFastestJoint) {
    warnings.push_back(JointTooFast(skeleton_, fastest_.frame, static_cast<int>(fastest_.joint),
                                    fastest_.m_per_s, key_id_,
                                    static_cast<double>(frames_) / fps_));
  }
  WarnOfFlight(aloft_);
  for (Warning& flight : std::exchange(flights_, {})) warnings.push_back(std::move(flight));
  return warnings;
}

}  // namespace choreo
