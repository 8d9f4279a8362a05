#include "model/fit/bone_normaliser.h"

#include <algorithm>

#include "model/core/error.h"
#include "model/core/quantile.h"
#include "model/fit/landmarks.h"
#include "model/motion/kinematics.h"

namespace choreo {

BoneNormaliser::BoneNormaliser(const Skeleton& skeleton, const SourceMapping& mapping,
                               const std::vector<std::string>& joint_names) {
  const LandmarkSet set(skeleton, mapping);
  const Eigen::Matrix3Xd rest = set.Positions(ForwardKinematics(skeleton, RestPose(skeleton)));
  for (size_t i = 0; i < mapping.landmarks.size(); ++i) {
    const Landmark& landmark = mapping.landmarks[i];
    Mark mark;
    for (const auto& [name, weight] : landmark.source) {
      const int joint = IndexOf(joint_names, name);
      if (joint < 0) {
        throw InvalidArgument("joint_names", "'" + name + "' is missing, which the landmark '" +
                                                 landmark.name + "' of the source '" +
                                                 mapping.name + "' needs");
      }
      mark.source.emplace_back(joint, weight);
    }
    mark.parent = landmark.parent;
    mark.rigid = landmark.rigid;
    mark.leg = landmark.name.ends_with("_knee") || landmark.name.ends_with("_ankle");
    mark.rest_length =
        landmark.parent < 0
            ? 0
            : (rest.col(static_cast<Eigen::Index>(i)) - rest.col(landmark.parent)).norm();
    marks_.push_back(std::move(mark));
  }
}

Eigen::Vector3d BoneNormaliser::SourcePoint(const Mark& mark, const Eigen::Matrix3Xd& source) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const auto& [joint, weight] : mark.source) point += weight * source.col(joint);
  return point;
}

SourceSize BoneNormaliser::Measure(const PositionClip& clip) const {
  ValidateClip(clip);
  SourceSize size;
  double our_legs = 0, their_legs = 0, our_bones = 0, their_bones = 0;
  std::vector<double> distances(clip.frames.size());
  for (const Mark& mark : marks_) {
    if (mark.parent < 0) {
      size.lengths.push_back(0);
      continue;
    }
    for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
      distances[frame] = (SourcePoint(mark, clip.frames[frame]) -
                          SourcePoint(marks_[mark.parent], clip.frames[frame]))
                             .norm();
    }
    size.lengths.push_back(Median(distances));
    (mark.leg ? our_legs : our_bones) += mark.rest_length;
    (mark.leg ? their_legs : their_bones) += size.lengths.back();
  }
  const double ours = their_legs > 0 ? our_legs : our_bones;
  const double theirs = their_legs > 0 ? their_legs : their_bones;
  if (!(theirs > 1e-6)) throw InvalidArgument("clip", "all landmarks stand in one place");
  size.scale = ours / theirs;
  size.height_scale = size.scale;
  return size;
}

double BoneNormaliser::HeightScale(const Eigen::Matrix3Xd& source) const {
  double ours = 0, theirs = 0;
  const bool legs =
      std::any_of(marks_.begin(), marks_.end(), [](const Mark& mark) { return mark.leg; });
  for (const Mark& mark : marks_) {
    if (mark.parent < 0 || mark.leg != legs) continue;
    ours += mark.rest_length;
    theirs += (SourcePoint(mark, source) - SourcePoint(marks_[mark.parent], source)).norm();
  }
  return theirs > 1e-6 ? ours / theirs : 1.0;
}

void BoneNormaliser::Apply(const Eigen::Matrix3Xd& source, const SourceSize& size,
                           Eigen::Matrix3Xd& targets) const {
  targets.resize(3, landmarks());
  for (int i = 0; i < landmarks(); ++i) {
    const Mark& mark = marks_[i];
    const Eigen::Vector3d point = SourcePoint(mark, source);
    if (mark.parent < 0) {
      targets.col(i) =
          point.cwiseProduct(Eigen::Vector3d(size.scale, size.height_scale, size.scale));
      continue;
    }
    const Eigen::Vector3d bone = point - SourcePoint(marks_[mark.parent], source);
    const double length = mark.rigid ? bone.norm() : size.lengths[i];
    // A bone without length has no direction: the landmark then stands at its parent's place.
    const double factor = length > 1e-9 ? mark.rest_length / length : 0;
    targets.col(i) = targets.col(mark.parent) + factor * bone;
  }
}

}  // namespace choreo
