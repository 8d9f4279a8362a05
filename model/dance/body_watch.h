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

/// Watches a dance, transition by transition, for what no body can do (motion/body_limits.h):
/// joints that are too fast, and flights that are too long. Not thread-safe.
class BodyWatch {
 public:
  /// `before`: the pose before the first frame, if there is one. The skeleton must outlive it.
  BodyWatch(const Skeleton& skeleton, double fps, const std::optional<Pose>& before);

  /// A transition of so many frames begins, to a key of this id or, if empty, to none.
  void Begin(const std::string& key_id, int64_t frames);
  void Add(int64_t frame, const Pose& pose);
  /// What went beyond the limits since Begin: its fastest step, and flights, each once.
  std::vector<Warning> Take();

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
  int64_t aloft_ = 0;                  // its frames
  bool told_ = false;                  // a warning of it was taken
  std::vector<Warning> flights_;
};

}  // namespace choreo
