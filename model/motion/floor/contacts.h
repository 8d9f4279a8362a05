#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Metres above the joint's height at rest. Up to kDownHeight a joint is on the floor, beyond
/// kUpHeight off it.
inline constexpr double kDownHeight = 0.04, kUpHeight = 0.07;

/// Detects foot contacts frame by frame. A foot joint touches down when it is both low and slow. It
/// lifts off above higher thresholds of height or speed (hysteresis), so contacts depend on earlier
/// frames. Heights are relative to the joint's own at rest. Not thread-safe.
class ContactDetector {
 public:
  /// Throws Error(kInvalidArgument) if the skeleton lacks a foot joint.
  explicit ContactDetector(const Skeleton& skeleton);

  /// Takes the joint positions of two consecutive frames, [3, joints], metres. Returns the contacts
  /// of the later one.
  const Contacts& Next(const Eigen::Matrix3Xd& earlier, const Eigen::Matrix3Xd& later, double fps);

  const Contacts& contacts() const { return contacts_; }

 private:
  std::array<int, 4> joints_;
  std::array<double, 4> rest_heights_;
  Contacts contacts_ = {};
};

/// Detects the contacts of every frame. The first frame takes its speed from the second; a single
/// frame counts as standing still.
std::vector<Contacts> DetectContacts(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
