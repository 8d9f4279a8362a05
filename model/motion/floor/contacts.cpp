#include "model/motion/floor/contacts.h"

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

// A foot joint touches down below the first speed and lifts off above the second, metres per
// second. 0.3 m/s is 1 cm per frame at 30 fps.
constexpr double kDownSpeed = 0.30, kUpSpeed = 0.50;

}  // namespace

ContactDetector::ContactDetector(const Skeleton& skeleton)
    : joints_(skeleton.feet), rest_heights_{} {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  for (size_t foot = 0; foot < joints_.size(); ++foot) {
    if (joints_[foot] < 0) {
      throw InvalidArgument("skeleton.feet", "the skeleton '" + skeleton.name +
                                                 "' does not name all four ankles and toes");
    }
    rest_heights_[foot] = rest(1, joints_[foot]);
  }
}

const Contacts& ContactDetector::Next(const Eigen::Matrix3Xd& earlier,
                                      const Eigen::Matrix3Xd& later, double fps) {
  for (size_t foot = 0; foot < joints_.size(); ++foot) {
    const int joint = joints_[foot];
    const double height = later(1, joint) - rest_heights_[foot];
    const double speed = (later.col(joint) - earlier.col(joint)).norm() * fps;
    const bool was_down = contacts_[foot] >= 0.5F;
    const double height_limit = was_down ? kUpHeight : kDownHeight;
    const double speed_limit = was_down ? kUpSpeed : kDownSpeed;
    contacts_[foot] = height <= height_limit && speed <= speed_limit ? 1.0F : 0.0F;
  }
  return contacts_;
}

std::vector<Contacts> DetectContacts(const Skeleton& skeleton, const Motion& motion) {
  std::vector<Contacts> contacts;
  if (motion.frames.empty()) return contacts;
  contacts.reserve(motion.frames.size());
  ContactDetector detector(skeleton);
  JointPlacement earlier = ForwardKinematics(skeleton, motion.frames.front());
  JointPlacement later = earlier;
  if (motion.frames.size() > 1) {
    // The step backwards from the second frame has the first frame's height and the step's speed.
    ForwardKinematics(skeleton, motion.frames[1], later);
  }
  contacts.push_back(detector.Next(later.positions, earlier.positions, motion.fps));
  for (size_t frame = 1; frame < motion.frames.size(); ++frame) {
    ForwardKinematics(skeleton, motion.frames[frame], later);
    contacts.push_back(detector.Next(earlier.positions, later.positions, motion.fps));
    std::swap(earlier, later);
  }
  return contacts;
}

}  // namespace choreo
