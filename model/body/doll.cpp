#include "model/body/doll.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "model/motion/kinematics/mirror.h"

namespace choreo {
namespace {

constexpr double kStickRadius = 0.035;  // metres, of bones without a known role
constexpr double kTrunkRadius = 0.085;
constexpr float kBlend = 0.012f, kBlendReach = 4 * kBlend;  // metres

// A DollBall whose joint is given by name.
struct Ball {
  const char* joint;
  float x, y, z;
  float radius;
};

struct NamedPart {
  Ball a, b;
  Colour colour;
};

// The left half; the right half mirrors "left" and x.
const NamedPart kSide[] = {
    // Leg: thigh, shin with calf, foot from ankle and heel to the toes.
    {{"left_hip", 0.012f, -0.02f, 0, 0.088f}, {"left_knee", 0, 0, 0, 0.056f}, kLeftColour},
    {{"left_knee", 0, 0, 0, 0.056f}, {"left_ankle", 0, 0, 0, 0.038f}, kLeftColour},
    {{"left_knee", 0, -0.12f, -0.018f, 0.052f}, {"left_ankle", 0, 0.05f, 0, 0.036f}, kLeftColour},
    {{"left_ankle", 0, -0.005f, 0, 0.040f}, {"left_foot", 0, 0.004f, 0.01f, 0.026f}, kLeftColour},
    {{"left_ankle", 0, -0.044f, -0.045f, 0.034f}, {"left_foot", 0, 0, 0.02f, 0.026f}, kLeftColour},
    {{"left_foot", 0, 0, 0, 0.026f}, {"left_foot", 0.006f, -0.002f, 0.065f, 0.018f}, kLeftColour},
    // Arm: upper arm, forearm, hand, thumb.
    {{"left_shoulder", 0, 0, 0, 0.056f}, {"left_elbow", 0, 0, 0, 0.040f}, kLeftColour},
    {{"left_elbow", 0, 0, 0, 0.040f}, {"left_wrist", 0, 0, 0, 0.028f}, kLeftColour},
    {{"left_wrist", 0.01f, 0, 0, 0.028f}, {"left_hand", 0, 0, 0, 0.031f}, kSkinColour},
    {{"left_hand", 0, 0, 0, 0.030f}, {"left_hand", 0.085f, -0.006f, 0, 0.015f}, kSkinColour},
    {{"left_wrist", 0.035f, 0, 0.02f, 0.016f},
     {"left_hand", 0.005f, -0.006f, 0.05f, 0.012f},
     kSkinColour},
    // Half of the trunk: hip, flank, ribs, shoulder, and the slope from the neck.
    {{"pelvis", 0, -0.03f, -0.012f, 0.105f},
     {"pelvis", 0.058f, -0.045f, -0.012f, 0.105f},
     kTrunkColour},
    {{"pelvis", 0.05f, -0.02f, -0.01f, 0.105f},
     {"spine2", 0.042f, -0.02f, 0.01f, 0.092f},
     kTrunkColour},
    {{"spine2", 0.042f, -0.02f, 0.01f, 0.092f},
     {"spine3", 0.07f, 0.08f, -0.004f, 0.098f},
     kTrunkColour},
    {{"spine3", 0.06f, 0.10f, -0.012f, 0.09f},
     {"left_shoulder", -0.01f, 0, 0, 0.060f},
     kTrunkColour},
    {{"neck", 0, -0.02f, 0, 0.060f}, {"left_shoulder", -0.02f, 0.01f, 0, 0.048f}, kTrunkColour},
};

const NamedPart kMiddle[] = {
    {{"pelvis", 0, 0, 0.005f, 0.108f}, {"spine2", 0, 0, 0.012f, 0.098f}, kTrunkColour},
    {{"spine2", 0, 0, 0.012f, 0.098f}, {"spine3", 0, 0.09f, 0.004f, 0.105f}, kTrunkColour},
    {{"neck", 0, -0.03f, 0, 0.058f}, {"head", 0, 0.01f, -0.012f, 0.052f}, kSkinColour},
    {{"head", 0, 0.095f, 0.004f, 0.094f}, {"head", 0, 0.022f, 0.038f, 0.062f}, kSkinColour},
    {{"head", 0, 0.045f, 0.106f, 0.015f}, {"head", 0, 0.078f, 0.092f, 0.011f}, kSkinColour},
    {{"head", 0, 0.120f, -0.010f, 0.094f}, {"head", 0, 0.055f, -0.030f, 0.080f}, kHairColour},
    {{"head", 0, 0.165f, -0.075f, 0.045f}, {"head", 0, 0.170f, -0.090f, 0.042f}, kHairColour},
};

// The doll's parts for SMPL's joints. A joint that the skeleton lacks is -1.
std::vector<DollPart> SmplParts(const Skeleton& skeleton) {
  std::vector<DollPart> doll;
  const auto as_it_is = [&](const Ball& ball) {
    return DollBall{skeleton.Find(ball.joint), {ball.x, ball.y, ball.z}, ball.radius};
  };
  const auto mirrored = [&](const Ball& ball) {
    return DollBall{skeleton.Find(OtherSide(ball.joint)), {-ball.x, ball.y, ball.z}, ball.radius};
  };
  for (const NamedPart& part : kMiddle) {
    doll.push_back({as_it_is(part.a), as_it_is(part.b), part.colour});
  }
  for (const NamedPart& part : kSide) {
    doll.push_back({as_it_is(part.a), as_it_is(part.b), part.colour});
    doll.push_back({mirrored(part.a), mirrored(part.b),
                    part.colour == kLeftColour ? kRightColour : part.colour});
  }
  return doll;
}

// Radius of the bone from each joint's parent, by the joints' roles, metres.
std::vector<double> BoneRadii(const Skeleton& skeleton) {
  std::vector<double> radii(skeleton.joints(), kStickRadius);
  const auto set = [&](int joint, double radius) {
    if (joint > 0) radii[joint] = radius;
  };
  for (const auto& [hip, knee, ankle, shoulder, elbow] :
       {std::array{skeleton.left_hip, skeleton.left_knee, skeleton.feet[0], skeleton.left_shoulder,
                   skeleton.left_elbow},
        std::array{skeleton.right_hip, skeleton.right_knee, skeleton.feet[2],
                   skeleton.right_shoulder, skeleton.right_elbow}}) {
    set(knee, 0.062);
    set(ankle, 0.044);
    set(elbow, 0.044);
    // The joints from hips and shoulders up to the root are the trunk.
    for (const int limb : {hip, shoulder}) {
      for (int joint = limb; joint > 0; joint = skeleton.parents[joint]) set(joint, kTrunkRadius);
    }
  }
  return radii;
}

// A capsule for every bone, bars across hips and shoulders, and a head if a joint has that name.
std::vector<DollPart> Capsules(const Skeleton& skeleton) {
  std::vector<DollPart> doll;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const std::vector<double> radii = BoneRadii(skeleton);
  for (int joint = 1; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[joint];
    const bool trunk = radii[joint] == kTrunkRadius;
    doll.push_back({{skeleton.parents[joint], zero, radii[joint]},
                    {joint, zero, radii[joint]},
                    trunk                        ? kTrunkColour
                    : name.starts_with("left_")  ? kLeftColour
                    : name.starts_with("right_") ? kRightColour
                                                 : kTrunkColour});
  }
  const auto bar = [&](int left, int right, double radius) {
    if (left < 1 || right < 1 || skeleton.parents[left] != skeleton.parents[right]) return;
    const int parent = skeleton.parents[left];
    doll.push_back({{parent, skeleton.offsets.col(left), radius},
                    {parent, skeleton.offsets.col(right), radius},
                    kTrunkColour});
  };
  bar(skeleton.left_hip, skeleton.right_hip, kTrunkRadius);
  bar(skeleton.left_shoulder, skeleton.right_shoulder, 0.6 * kTrunkRadius);
  const int head = skeleton.Find("head");
  for (const NamedPart& part : kMiddle) {
    if (head < 0 || std::string_view(part.a.joint) != "head") continue;
    doll.push_back({{head, {part.a.x, part.a.y, part.a.z}, part.a.radius},
                    {head, {part.b.x, part.b.y, part.b.z}, part.b.radius},
                    part.colour});
  }
  return doll;
}

double LowestPoint(const std::vector<PlacedPart>& body) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const auto& [shape, colour] : body)
    lowest = std::min({lowest, shape.a.y() - shape.radius_a, shape.b.y() - shape.radius_b});
  return lowest;
}

}  // namespace

std::vector<DollPart> MakeDoll(const Skeleton& skeleton) {
  const std::vector<DollPart> doll = SmplParts(skeleton);
  const bool complete = std::ranges::all_of(
      doll, [](const DollPart& part) { return part.a.joint >= 0 && part.b.joint >= 0; });
  return complete ? doll : Capsules(skeleton);
}

std::vector<PlacedPart> PlaceDoll(const std::vector<DollPart>& doll,
                                  const JointPlacement& placement) {
  const auto place = [&](const DollBall& ball) -> Eigen::Vector3f {
    return (placement.positions.col(ball.joint) + placement.rotations[ball.joint] * ball.offset)
        .cast<float>();
  };
  std::vector<PlacedPart> parts;
  for (const DollPart& part : doll) {
    parts.push_back({{place(part.a), place(part.b), static_cast<float>(part.a.radius),
                      static_cast<float>(part.b.radius)},
                     part.colour});
  }
  return parts;
}

std::vector<PlacedPart> BuildDoll(const Skeleton& skeleton, const Pose& pose) {
  return PlaceDoll(MakeDoll(skeleton), ForwardKinematics(skeleton, pose));
}

double DollAboveFloor(const Skeleton& skeleton, const Pose& pose) {
  return LowestPoint(BuildDoll(skeleton, pose)) -
         LowestPoint(BuildDoll(skeleton, RestPose(skeleton)));
}

std::vector<const PlacedPart*> SkinAround(const std::vector<PlacedPart>& parts, size_t index) {
  const BoundedCone part(parts[index].shape);
  std::vector<const PlacedPart*> around;
  for (const PlacedPart& other : parts) {
    const BoundedCone bounds(other.shape);
    const float reach = 1.01f * (part.radius + bounds.radius + kBlendReach);
    if (&other != &parts[index] && other.colour == parts[index].colour &&
        (bounds.middle - part.middle).norm() < reach) {
      around.push_back(&other);
    }
  }
  return around;
}

Eigen::Vector3f SkinNormal(const std::vector<const PlacedPart*>& around,
                           const Eigen::Vector3f& point, const Eigen::Vector3f& own) {
  Eigen::Vector3f sum = own;
  for (const PlacedPart* part : around) {
    Eigen::Vector3f normal;
    const float distance = SurfaceDistance(part->shape, point, normal);
    if (distance < kBlendReach) sum += std::exp(-std::max(0.0f, distance) / kBlend) * normal;
  }
  return sum.normalized();
}

}  // namespace choreo
