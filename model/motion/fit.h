#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/motion/fit_sources.h"
#include "model/motion/motion.h"
#include "model/motion/position_clip.h"
#include "model/motion/skeleton.h"

/// Joint positions → rotations of our skeleton. Two steps: the source is bone-normalised (its
/// directions, our lengths), then each frame's rotations are the damped least-squares solution that
/// puts our landmarks there, started from the frame before.
namespace choreo {

/// The source's size, measured once per subject.
struct SourceSize {
  double scale = 1;             ///< our leg length over the source's: multiplies the root's travel
  double height_scale = 1;      ///< the same at one moment: multiplies the root's height
  std::vector<double> lengths;  ///< [landmarks] source metres from the parent landmark (median)
};

/// Turns source positions into the places where our landmarks belong. Immutable after construction.
class BoneNormaliser {
 public:
  /// Throws Error(kInvalidArgument) for a landmark whose joints `joint_names` or the skeleton lack.
  BoneNormaliser(const Skeleton& skeleton, const SourceMapping& mapping,
                 const std::vector<std::string>& joint_names);

  /// Median landmark distances of a clip, and the scale from the legs' lengths (hip, knee, ankle;
  /// from all bones where a mapping has no knees).
  SourceSize Measure(const PositionClip& clip) const;

  /// Our leg length over the source's in one frame. Recordings are sometimes cut together from
  /// takes whose hips stand at different places in the body (tang2018: thighs of 46 and of 54 cm in
  /// one clip): the root's height then needs a scale that changes in time.
  double HeightScale(const Eigen::Matrix3Xd& source) const;

  /// Source joints [3, K] → landmark targets [3, landmarks] in metres at our size. Does not
  /// allocate where `targets` has that size.
  void Apply(const Eigen::Matrix3Xd& source, const SourceSize& size,
             Eigen::Matrix3Xd& targets) const;

  int landmarks() const { return static_cast<int>(marks_.size()); }

 private:
  struct Mark {
    std::vector<std::pair<int, double>> source;  ///< joint, weight
    int parent;
    bool rigid;
    bool leg;            ///< counts for the scale
    double rest_length;  ///< ours, from the parent
  };
  static Eigen::Vector3d SourcePoint(const Mark& mark, const Eigen::Matrix3Xd& source);

  std::vector<Mark> marks_;
};

/// How hard what pulls: standard deviations of the least-squares terms, beside
/// SourceMapping::accuracy_m.
struct FitOptions {
  double rest_rad = 1.2;           ///< every joint towards its rest rotation
  double stiff_rad = 0.5;          ///< the same of spine, collars, neck, head, wrists and feet
  double twist_rad = 0.7;          ///< of hips and shoulders about the bone below
  double foot_turn_rad = 0.35;     ///< of ankles about the shin
  double hinge_side_rad = 0.35;    ///< knees and elbows off their hinge axis
  double hinge_limit_rad = 0.006;  ///< knees and elbows beyond straight
  double hinge_plane_rad = 0.2;    ///< of the hinge axis from the plane of a bent limb
  double change_rad = 0.12;        ///< of every joint since the frame before, at 30 fps
  int iterations = 3;              ///< per warm-started frame
  int first_iterations = 60;       ///< of a frame without a predecessor
  bool recover = true;             ///< begin anew where the fit is lost, even if that jumps
  bool ground = true;              ///< FitClip alone: bring the body down to the floor
};

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

  /// Where our landmarks stand in the pose that Next returned last, [3, landmarks].
  const Eigen::Matrix3Xd& landmarks() const;

  /// Forgets the frame before.
  void Reset();
  /// Goes on from this pose, as if it had been the frame before.
  void Reset(const Pose& previous);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

struct FitReport {
  double mean_error_m = 0;  ///< over frames and landmarks, against the bone-normalised source
  double p95_error_m = 0;
  double max_error_m = 0;
  std::vector<std::string> landmark_names;
  std::vector<double> landmark_error_m;  ///< [landmarks] mean
  double scale = 1;                      ///< SourceSize::scale
  double ground_shift_m = 0;             ///< what was added to the heights, on average
};

struct FitResult {
  Motion motion;  ///< at the clip's fps
  FitReport report;
};

/// [joints] How much of the body lies below each joint where it touches the floor, metres: below a
/// foot joint as much as at rest, below any other at most 5 cm.
Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton);

/// How far the lowest point of the body is above the floor, metres, by that clearance.
double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose);

/// Brings the body down to the floor at least every few seconds. What is taken off changes slowly,
/// so that jumps stay. Returns the mean of what was added to the heights, metres.
double Ground(const Skeleton& skeleton, Motion& motion);

/// A whole clip: measure, normalise, fit forwards, refine once with both neighbours known (zero
/// phase), and ground. About 0.5 ms a frame.
FitResult FitClip(const PositionClip& clip, const SourceMapping& mapping, const Skeleton& skeleton,
                  const FitOptions& options = {});

}  // namespace choreo
