#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Body parts with a velocity factor (paper C, Section 3.3.2, Eq. 1).
enum class BodyPart { kTrunk, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
inline constexpr int kBodyParts = 5;

/// "trunk", "left_arm", "right_arm", "left_leg", "right_leg", in the order of BodyPart.
inline constexpr std::array<std::string_view, kBodyParts> kBodyPartNames = {
    "trunk", "left_arm", "right_arm", "left_leg", "right_leg"};

/// All of them, for messages: "trunk, left_arm, ...".
std::string BodyPartNames();

/// The part with this name, or none.
std::optional<BodyPart> FindBodyPart(std::string_view name);

/// A model's usual speeds, to which multipliers of velocity factors refer.
struct VelocityReference {
  std::string name = {};
  std::array<float, kBodyParts> speeds = {};  ///< by BodyPart, metres a frame at the model's rate
};

/// Limits of the velocity factors in a request.
inline constexpr float kMaxVelocityFactor = 10;  ///< as a multiple of a reference
inline constexpr float kMaxVelocity = 0.5F;      ///< metres a frame

/// Added to the EnergyLevel (flow/priors/motion_prior.h) of body parts without a velocity factor,
/// in the frames before and in the frames to come.
struct EnergyShift {
  double before = 0, now = 0;
};

/// The tolerances within which paper C counts a control as met (Section 4.3).
inline constexpr double kVelocityTolerance = 0.01;  ///< delta_v: 1 cm a frame
inline constexpr double kRootTolerance = 0.07;      ///< delta_r: the root off its path, 7 cm

/// [5, joints]: the share of each joint in each part's factor. A joint belongs to one part; every
/// row sums to 1.
using BodyPartWeights = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// The weights before normalisation, by joint name (paper C, Figure 4; its authors' code): legs 1,
/// 2, 3, 4 from hip over knee and ankle to toes (a heel: 4); arms 1, 2, 3, 4 from shoulder over
/// elbow and wrist to hand (a thumb: 4; a collar belongs to its arm: 1); trunk: the root, the
/// spine, the chest and the neck 1, the head 2. Throws Error(kInvalidArgument) naming a joint that
/// fits none of these, or a part without joints.
BodyPartWeights WeighBodyParts(const Skeleton& skeleton);

/// The speeds of one frame (paper C's velocity factors), metres a frame, each at least 0: for each
/// part the weighted mean of its joints' speeds since the frame before. The root moves in the
/// world, other joints relative to the root along world axes (the paper's p_t^r, p_t^b). Positions
/// are [3, joints], metres, joint 0 the root. Thread-safe; moving or turning the scene does not
/// change them.
std::array<double, kBodyParts> PartSpeeds(const BodyPartWeights& weights,
                                          const Eigen::Matrix3Xd& positions_before,
                                          const Eigen::Matrix3Xd& positions);

/// The mean PartSpeeds over the steps of a motion of at least two poses.
std::array<double, kBodyParts> MeanPartSpeeds(const Skeleton& skeleton,
                                              std::span<const Pose> poses);

}  // namespace choreo
