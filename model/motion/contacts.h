#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Metres above rest height: up to the first a joint is on the floor; beyond the second it is off
/// it.
inline constexpr double kDownHeight = 0.04, kUpHeight = 0.07;

/// Detects contacts frame by frame. A foot joint touches down when it is both low and slow, and
/// stays down until it is half as high or fast again: contacts depend on their frame and those
/// before. Heights are relative to the joint's own at rest. Not thread-safe.
class ContactDetector {
 public:
  /// Throws Error(kInvalidArgument) if the skeleton lacks a foot joint.
  explicit ContactDetector(const Skeleton& skeleton);

  /// Joint positions of two consecutive frames, [3, joints].
  const Contacts& Next(const Eigen::Matrix3Xd& earlier, const Eigen::Matrix3Xd& later, double fps);

  const Contacts& contacts() const { return contacts_; }

 private:
  std::array<int, 4> joints_;
  std::array<double, 4> rest_heights_;
  Contacts contacts_ = {};
};

/// Contacts of every frame. The first frame takes its speed from the next step; a single frame
/// counts as standing still.
std::vector<Contacts> DetectContacts(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
