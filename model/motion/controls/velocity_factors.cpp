#include "model/motion/controls/velocity_factors.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

struct Membership {
  BodyPart part;
  double weight;
};

constexpr std::pair<std::string_view, double> kTrunk[] = {
    {"pelvis", 1}, {"waist", 1},  {"hips", 1},  {"spine", 1}, {"spine1", 1},
    {"spine2", 1}, {"spine3", 1}, {"chest", 1}, {"neck", 1},  {"head", 2}};
constexpr std::pair<std::string_view, double> kArm[] = {
    {"collar", 1}, {"shoulder", 1}, {"elbow", 2}, {"wrist", 3}, {"hand", 4}, {"thumb", 4}};
constexpr std::pair<std::string_view, double> kLeg[] = {
    {"hip", 1}, {"knee", 2}, {"ankle", 3}, {"heel", 4}, {"foot", 4}, {"toe", 4}, {"toes", 4}};

template <size_t size>
std::optional<double> Find(const std::pair<std::string_view, double> (&weights)[size],
                           std::string_view name) {
  for (const auto& [joint, weight] : weights) {
    if (joint == name) return weight;
  }
  return std::nullopt;
}

std::optional<Membership> FindMembership(std::string_view name) {
  if (const auto weight = Find(kTrunk, name)) return Membership{BodyPart::kTrunk, *weight};
  for (const auto& [side, arm, leg] :
       {std::tuple{std::string_view("left_"), BodyPart::kLeftArm, BodyPart::kLeftLeg},
        std::tuple{std::string_view("right_"), BodyPart::kRightArm, BodyPart::kRightLeg}}) {
    if (!name.starts_with(side)) continue;
    const std::string_view joint = name.substr(side.size());
    if (const auto weight = Find(kArm, joint)) return Membership{arm, *weight};
    if (const auto weight = Find(kLeg, joint)) return Membership{leg, *weight};
  }
  return std::nullopt;
}

}  // namespace

std::string BodyPartNames() { return Joined(kBodyPartNames); }

std::optional<BodyPart> FindBodyPart(std::string_view name) {
  const auto found = std::ranges::find(kBodyPartNames, name);
  if (found == kBodyPartNames.end()) return std::nullopt;
  return static_cast<BodyPart>(found - kBodyPartNames.begin());
}

BodyPartWeights WeighBodyParts(const Skeleton& skeleton) {
  BodyPartWeights weights = BodyPartWeights::Zero(kBodyParts, skeleton.joints());
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[joint];
    // The root belongs to the trunk, whatever its name.
    const auto member = joint == 0 ? Membership{BodyPart::kTrunk, 1} : FindMembership(name);
    if (!member) {
      throw InvalidArgument("skeleton", skeleton.Describe() + ": '" + name +
                                            "' belongs to no body part that velocity factors know");
    }
    weights(static_cast<int>(member->part), joint) = member->weight;
  }
  for (int part = 0; part < kBodyParts; ++part) {
    const double sum = weights.row(part).sum();
    if (sum == 0) {
      throw InvalidArgument("skeleton", skeleton.Describe() + ": no joint belongs to the " +
                                            std::string(kBodyPartNames[part]));
    }
    weights.row(part) /= sum;
  }
  return weights;
}

std::array<double, kBodyParts> PartSpeeds(const BodyPartWeights& weights,
                                          const Eigen::Matrix3Xd& positions_before,
                                          const Eigen::Matrix3Xd& positions) {
  const Eigen::Vector3d root_step = positions.col(0) - positions_before.col(0);
  std::array<double, kBodyParts> factors = {};
  for (int joint = 0; joint < positions.cols(); ++joint) {
    const Eigen::Vector3d step = positions.col(joint) - positions_before.col(joint);
    const double speed = joint == 0 ? step.norm() : (step - root_step).norm();
    for (int part = 0; part < kBodyParts; ++part) factors[part] += weights(part, joint) * speed;
  }
  return factors;
}

std::array<double, kBodyParts> MeanPartSpeeds(const Skeleton& skeleton,
                                              std::span<const Pose> poses) {
  const BodyPartWeights weights = WeighBodyParts(skeleton);
  std::array<double, kBodyParts> mean = {};
  Eigen::Matrix3Xd before = JointPositions(skeleton, poses.front());
  for (const Pose& pose : poses.subspan(1)) {
    const Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
    const std::array<double, kBodyParts> factors = PartSpeeds(weights, before, now);
    for (size_t part = 0; part < mean.size(); ++part)
      mean[part] += factors[part] / static_cast<double>(poses.size() - 1);
    before = now;
  }
  return mean;
}

}  // namespace choreo
