#include "model/fit/solver/bone_normaliser.h"

#include <algorithm>

#include "model/core/error.h"
#include "model/core/numbers/quantile.h"
#include "model/fit/sources/landmarks.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {

BoneNormaliser::BoneNormaliser(const Skeleton& skeleton, const SourceMapping& mapping,
                               const std::vector<std::string>& joint_names) {
  const LandmarkSet set(skeleton, mapping);
  const Eigen::Matrix3Xd rest = set.Positions(ForwardKinematics(skeleton, RestPose(skeleton)));
  for (size_t i = 0; i < mapping.landmarks.size(); ++i) {
    const Landmark& landmark = mapping.landmarks[i];
    Mark mark;
    mark.parent = landmark.parent;
    mark.rigid = landmark.rigid;
    mark.leg = landmark.name.ends_with("_knee") || landmark.name.ends_with("_ankle");
    for (const auto& [name, weight] : landmark.source) {
      const int joint = IndexOf(joint_names, name);
      if (joint < 0) {
        throw InvalidArgument("joint_names", "'" + name + "' is missing, which the landmark '" +
                                                 landmark.name + "' of the source '" +
                                                 mapping.name + "' needs");
      }
      mark.source.emplace_back(joint, weight);
    }
    if (mark.parent >= 0) mark.rest_length = (rest.col(i) - rest.col(mark.parent)).norm();
    marks_.push_back(std::move(mark));
  }
}

Eigen::Vector3d BoneNormaliser::SourcePoint(const Mark& mark, const Eigen::Matrix3Xd& source) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const auto& [joint, weight] : mark.source) point += weight * source.col(joint);
  return point;
}

Eigen::Vector3d BoneNormaliser::SourceBone(const Mark& mark, const Eigen::Matrix3Xd& source) const {
  return SourcePoint(mark, source) - SourcePoint(marks_[mark.parent], source);
}

SourceSize BoneNormaliser::Measure(const PositionClip& clip) const {
  SourceSize size;
  double our_legs = 0, their_legs = 0, our_bones = 0, their_bones = 0;
  std::vector<double> distances(clip.frames.size());
  for (const Mark& mark : marks_) {
    if (mark.parent < 0) {
      size.lengths.push_back(0);
      continue;
    }
    std::ranges::transform(clip.frames, distances.begin(), [&](const Eigen::Matrix3Xd& frame) {
      return SourceBone(mark, frame).norm();
    });
    size.lengths.push_back(Median(distances));
    (mark.leg ? our_legs : our_bones) += mark.rest_length;
    (mark.leg ? their_legs : their_bones) += size.lengths.back();
  }
  const double ours = their_legs > 0 ? our_legs : our_bones;
  const double theirs = their_legs > 0 ? their_legs : their_bones;
  if (!(theirs > 1e-6)) throw InvalidArgument("clip", "all landmarks are in one place");
  size.scale = ours / theirs;
  return size;
}

double BoneNormaliser::HeightScale(const Eigen::Matrix3Xd& source) const {
  double ours = 0, theirs = 0;
  const bool legs = std::ranges::any_of(marks_, &Mark::leg);
  for (const Mark& mark : marks_) {
    if (mark.parent < 0 || mark.leg != legs) continue;
    ours += mark.rest_length;
    theirs += SourceBone(mark, source).norm();
  }
  return theirs > 1e-6 ? ours / theirs : 1.0;
}

Eigen::Matrix3Xd BoneNormaliser::Apply(const Eigen::Matrix3Xd& source, const SourceSize& size,
                                       double height_scale) const {
  Eigen::Matrix3Xd targets(3, std::ssize(marks_));
  for (Eigen::Index i = 0; i < targets.cols(); ++i) {
    const Mark& mark = marks_[i];
    if (mark.parent < 0) {
      targets.col(i) = SourcePoint(mark, source)
                           .cwiseProduct(Eigen::Vector3d(size.scale, height_scale, size.scale));
      continue;
    }
    const Eigen::Vector3d bone = SourceBone(mark, source);
    const double length = mark.rigid ? bone.norm() : size.lengths[i];
    // A bone of no length has no direction, so its landmark is put at its parent.
    const double factor = length > 1e-9 ? mark.rest_length / length : 0;
    targets.col(i) = targets.col(mark.parent) + factor * bone;
  }
  return targets;
}

}  // namespace choreo
