#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/messages/dance_event.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Checks a dance, transition by transition, against the limits of human bodies
/// (motion/pose/body_limits.h): joint speed and length of flight. Not thread-safe.
class BodyWatch {
 public:
  /// `before`: the pose before the first frame, if any. The skeleton must outlive this object.
  BodyWatch(const Skeleton& skeleton, double fps, const std::optional<Pose>& before);

  /// Begins a transition of `frames` frames to the key with this id; an empty id means no key.
  void StartTransition(const std::string& key_id, int64_t frames);
  void Add(int64_t frame, const Pose& pose);
  /// Returns warnings about limits exceeded since StartTransition: one for the fastest step, and
  /// one for each flight.
  std::vector<Warning> TakeWarnings();

 private:
  void WatchFlight(int64_t frame, const Eigen::Matrix3Xd& joints);
  void WarnOfFlight(int64_t frames);

  const Skeleton& skeleton_;
  double fps_;
  Eigen::RowVectorXd clearance_;
  std::optional<Eigen::Matrix3Xd> last_;  // [3, joints]
  std::string key_id_;
  int64_t frames_ = 0;
  struct Fastest {
    double m_per_s = 0;
    Eigen::Index joint = 0;
    int64_t frame = 0;
  } fastest_;
  std::optional<int64_t> aloft_from_;  // the first frame of the present flight
  int64_t aloft_ = 0;                  // frames of the present flight so far
  bool told_ = false;                  // whether the present flight's warning was taken
  std::vector<Warning> flights_;
};

}  // namespace choreo
