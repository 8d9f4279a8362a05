#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/sources/position_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A recorded person's size, measured once.
struct SourceSize {
  double scale = 1;  ///< our leg length over the source's, which scales the root's travel
  std::vector<double> lengths;  ///< [landmarks] source metres from the parent landmark (median)
};

/// Converts source positions to targets for our landmarks: the source's directions with our bone
/// lengths. Immutable after construction; thread-safe.
class BoneNormaliser {
 public:
  /// Throws Error(kInvalidArgument) for a landmark whose joints are missing in `joint_names` or the
  /// skeleton.
  BoneNormaliser(const Skeleton& skeleton, const SourceMapping& mapping,
                 const std::vector<std::string>& joint_names);

  /// Measures a clip's median distances between landmarks. The scale comes from the legs (hip,
  /// knee, ankle), or from all bones if the mapping has no knees.
  SourceSize Measure(const PositionClip& clip) const;

  /// Our leg length over the source's in one frame. Some recordings join takes with hips at
  /// different places in the body (tang2018: thighs of 46 and of 54 cm in one clip), so the scale
  /// of the root's height changes over time.
  double HeightScale(const Eigen::Matrix3Xd& source) const;

  /// Converts source joints [3, K] to landmark targets [3, landmarks], metres, at our size.
  /// `height_scale`: the HeightScale around this time, which multiplies the root's height.
  Eigen::Matrix3Xd Apply(const Eigen::Matrix3Xd& source, const SourceSize& size,
                         double height_scale) const;

 private:
  struct Mark {
    std::vector<std::pair<int, double>> source;  ///< joint, weight
    int parent;
    bool rigid;
    bool leg;                ///< counts for the scale
    double rest_length = 0;  ///< ours, from the parent
  };
  static Eigen::Vector3d SourcePoint(const Mark& mark, const Eigen::Matrix3Xd& source);
  /// The bone from the parent, for marks with one.
  Eigen::Vector3d SourceBone(const Mark& mark, const Eigen::Matrix3Xd& source) const;

  std::vector<Mark> marks_;
};

}  // namespace choreo
