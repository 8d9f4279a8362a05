#pragma once

#include <Eigen/Core>

#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Encodes poses as the feature vector x_t of paper F (Section 3.2.1): root position (3), rotation
/// vectors (3 per joint), forward, sideways and yaw velocity (3), contacts (4); 82 numbers for
/// SMPL's 24 joints. Metres, radians, m/s and rad/s, not standardised.
///
/// Rotation vectors use the branch nearest to the previous pose's. Immutable, hence safe to share
/// between threads. No function allocates if its output has the right size.
class PoseCodec {
 public:
  explicit PoseCodec(const Skeleton& skeleton) : joints_(skeleton.joints()) {}

  int joints() const { return joints_; }
  int width() const { return contacts_at() + 4; }
  static constexpr int position_at() { return 0; }
  static constexpr int rotations_at() { return 3; }
  int velocity_at() const { return rotations_at() + 3 * joints_; }
  int contacts_at() const { return velocity_at() + 3; }

  /// `previous` is the frame before, 1 / fps earlier (for the very first frame, that frame itself).
  /// Throws Error(kInvalidArgument) for a joint count other than the skeleton's, or if `out` does
  /// not have size width().
  void Encode(const Pose& pose, const Pose& previous, const Contacts& contacts, double fps,
              Eigen::Ref<Eigen::VectorXf> out) const;
  Eigen::VectorXf Encode(const Pose& pose, const Pose& previous, const Contacts& contacts,
                         double fps) const;

  struct Decoded {
    Pose pose;
    Contacts contacts = {};  ///< as stored in the vector; a model's may be outside [0, 1]
  };
  /// The inverse of Encode. Ignores the velocity, which follows from the poses.
  void Decode(Eigen::Ref<const Eigen::VectorXf> x, Decoded& out) const;
  Decoded Decode(Eigen::Ref<const Eigen::VectorXf> x) const;

 private:
  void CheckJoints(const Pose& pose, const char* field) const;

  int joints_;
};

}  // namespace choreo
