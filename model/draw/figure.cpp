#include "model/draw/figure.h"

#include <string>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr Colour kTorso = Colour::Hex(0xe6ddd0);
constexpr Colour kSkin = Colour::Hex(0xdfb08c);
constexpr Colour kHair = Colour::Hex(0x4b382e);
constexpr float kStickRadius = 0.035f;

// A ball that moves with a joint: offset in the joint's frame (at rest x to the left, y up, z
// forward) and radius, metres.
struct Ball {
  const char* joint;
  float x, y, z;
  float radius;
};

struct DollPart {
  Ball a, b;
  Colour colour;
};

// The left half; "left" and x are mirrored for the right one.
const DollPart kSide[] = {
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
    {{"left_wrist", 0.01f, 0, 0, 0.028f}, {"left_hand", 0, 0, 0, 0.031f}, kSkin},
    {{"left_hand", 0, 0, 0, 0.030f}, {"left_hand", 0.085f, -0.006f, 0, 0.015f}, kSkin},
    {{"left_wrist", 0.035f, 0, 0.02f, 0.016f},
     {"left_hand", 0.005f, -0.006f, 0.05f, 0.012f},
     kSkin},
    // Half of the trunk: hip, flank, ribs, shoulder, and the slope from the neck.
    {{"pelvis", 0, -0.03f, -0.012f, 0.105f}, {"pelvis", 0.058f, -0.045f, -0.012f, 0.105f}, kTorso},
    {{"pelvis", 0.05f, -0.02f, -0.01f, 0.105f}, {"spine2", 0.042f, -0.02f, 0.01f, 0.092f}, kTorso},
    {{"spine2", 0.042f, -0.02f, 0.01f, 0.092f}, {"spine3", 0.07f, 0.08f, -0.004f, 0.098f}, kTorso},
    {{"spine3", 0.06f, 0.10f, -0.012f, 0.09f}, {"left_shoulder", -0.01f, 0, 0, 0.060f}, kTorso},
    {{"neck", 0, -0.02f, 0, 0.060f}, {"left_shoulder", -0.02f, 0.01f, 0, 0.048f}, kTorso},
};

const DollPart kMiddle[] = {
    {{"pelvis", 0, 0, 0.005f, 0.108f}, {"spine2", 0, 0, 0.012f, 0.098f}, kTorso},
    {{"spine2", 0, 0, 0.012f, 0.098f}, {"spine3", 0, 0.09f, 0.004f, 0.105f}, kTorso},
    {{"neck", 0, -0.03f, 0, 0.058f}, {"head", 0, 0.01f, -0.012f, 0.052f}, kSkin},
    {{"head", 0, 0.095f, 0.004f, 0.094f}, {"head", 0, 0.022f, 0.038f, 0.062f}, kSkin},
    {{"head", 0, 0.045f, 0.106f, 0.015f}, {"head", 0, 0.078f, 0.092f, 0.011f}, kSkin},
    {{"head", 0, 0.120f, -0.010f, 0.094f}, {"head", 0, 0.055f, -0.030f, 0.080f}, kHair},
    {{"head", 0, 0.165f, -0.075f, 0.045f}, {"head", 0, 0.170f, -0.090f, 0.042f}, kHair},
};

Ball Mirrored(const Ball& ball) { return {ball.joint, -ball.x, ball.y, ball.z, ball.radius}; }

std::string RightName(const std::string& name) {
  return name.starts_with("left_") ? "right_" + name.substr(5) : name;
}

class Builder {
 public:
  Builder(const Skeleton& skeleton, const Pose& pose)
      : skeleton_(skeleton), placement_(ForwardKinematics(skeleton, pose)) {}

  // False where the skeleton does not have a joint that the doll needs.
  bool AddDoll() {
    for (const DollPart& part : kMiddle) {
      if (!Add(part.a, part.b, part.a.joint, part.b.joint, part.colour)) return false;
    }
    for (const DollPart& part : kSide) {
      if (!Add(part.a, part.b, part.a.joint, part.b.joint, part.colour)) return false;
      const bool limb = part.colour.r == kLeftColour.r;
      if (!Add(Mirrored(part.a), Mirrored(part.b), RightName(part.a.joint), RightName(part.b.joint),
               limb ? kRightColour : part.colour)) {
        return false;
      }
    }
    return true;
  }

  void AddSticks() {
    parts_.clear();
    for (int joint = 1; joint < skeleton_.joints(); ++joint) {
      const std::string& name = skeleton_.joint_names[joint];
      const bool left = name.find("left") != std::string::npos;
      const bool right = name.find("right") != std::string::npos;
      parts_.push_back({{placement_.positions.col(skeleton_.parents[joint]).cast<float>(),
                         placement_.positions.col(joint).cast<float>(), kStickRadius, kStickRadius},
                        left    ? kLeftColour
                        : right ? kRightColour
                                : kTorso});
    }
  }

  std::vector<BodyPart> Take() { return std::move(parts_); }

 private:
  bool Add(const Ball& a, const Ball& b, const std::string& joint_a, const std::string& joint_b,
           const Colour& colour) {
    const int index_a = skeleton_.Find(joint_a), index_b = skeleton_.Find(joint_b);
    if (index_a < 0 || index_b < 0) return false;
    parts_.push_back({{Place(index_a, a), Place(index_b, b), a.radius, b.radius}, colour});
    return true;
  }

  Eigen::Vector3f Place(int joint, const Ball& ball) const {
    const Eigen::Vector3d offset(ball.x, ball.y, ball.z);
    return (placement_.positions.col(joint) + placement_.rotations[joint] * offset).cast<float>();
  }

  const Skeleton& skeleton_;
  JointPlacement placement_;
  std::vector<BodyPart> parts_;
};

}  // namespace

std::vector<BodyPart> BuildFigure(const Skeleton& skeleton, const Pose& pose) {
  Builder builder(skeleton, pose);
  if (!builder.AddDoll()) builder.AddSticks();
  return builder.Take();
}

}  // namespace choreo
