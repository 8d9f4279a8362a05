#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/fit/sources.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How hard what pulls: standard deviations of the least-squares terms, beside
/// SourceMapping::accuracy_m.
struct FitOptions {
  double rest_rad = 1.2;           ///< every joint towards its rest rotation
  double stiff_rad = 0.5;          ///< the same of spine, collars, neck, head, wrists and feet
  double twist_rad = 0.7;          ///< of hips and shoulders about the bone below
  double foot_turn_rad = 0.35;     ///< of ankles about the shin
  double hinge_side_rad = 0.35;    ///< knees and elbows off their hinge axis
  double hinge_limit_rad = 0.006;  ///< knees and elbows beyond straight
  double change_rad = 0.12;        ///< of every joint since the frame before, at 30 fps
  int iterations = 3;              ///< per warm-started frame
  bool recover = true;             ///< begin anew where the fit is lost, even if that jumps
  bool ground = true;              ///< FitClip alone: bring the body down to the floor
};

class FitProblem;
struct FitNeighbours;

/// Fits frame after frame, causally: a frame's result depends on it and the frames before. Not
/// thread-safe; one per stream.
class PositionFitter {
 public:
  PositionFitter(const Skeleton& skeleton, const SourceMapping& mapping,
                 const FitOptions& options = {}, double fps = 30);
  ~PositionFitter();
  PositionFitter(PositionFitter&&) noexcept;
  PositionFitter& operator=(PositionFitter&&) noexcept;

  /// Landmark targets [3, landmarks] → the pose, on the exp-map branch nearest to the frame before.
  /// What they leave open, such as how a straight arm is turned about itself, changes little from
  /// the frame before and stays close to `after`'s, where it is given.
  const Pose& Next(const Eigen::Matrix3Xd& targets, const Pose* after = nullptr);

  /// Goes on from this pose, as if it had been the frame before.
  void Reset(const Pose& previous);

 private:
  void Recover(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, double distance);

  std::unique_ptr<FitProblem> problem_;
  FitOptions options_;
  Pose pose_, previous_, fresh_;
  bool has_previous_ = false;
};

}  // namespace choreo
