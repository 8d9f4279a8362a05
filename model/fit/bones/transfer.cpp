#include "model/fit/bones/transfer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "model/core/numbers/gaussian_mean.h"
#include "model/core/numbers/smooth_step.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Metres at SMPL's size: a hand nearer than kTouches touches, one farther than kFree is free.
constexpr double kTouches = 0.12, kFree = 0.32;
// Seconds of smoothing, so that a hand that swings past the hips does not jerk.
constexpr double kDraws = 0.08;
constexpr double kNoWay = 1e-6;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

Eigen::Vector3d Col(const Eigen::Matrix3Xd& places, int joint) { return places.col(joint); }

Eigen::Vector3d MiddleOfHips(const Skeleton& skeleton, const Eigen::Matrix3Xd& places) {
  return (places.col(skeleton.left_hip) + places.col(skeleton.right_hip)) / 2;
}

double LegHeight(const Skeleton& skeleton) {
  const auto drop = [&](int knee, int ankle) {
    return -skeleton.offsets(1, knee) - skeleton.offsets(1, ankle);
  };
  return (drop(skeleton.left_knee, skeleton.feet[0]) +
          drop(skeleton.right_knee, skeleton.feet[2])) /
         2;
}

/// Chooses the global rotation of SMPL's body that a character's joint takes.
class Takes {
 public:
  explicit Takes(const Skeleton& character) {
    int spines = 0, necks = 0;
    for (const std::string& name : character.joint_names) {
      spines += name.starts_with("spine") ? 1 : 0;
      necks += name.starts_with("neck") ? 1 : 0;
    }
    int spine = 0, neck = 0;
    for (const std::string& name : character.joint_names) {
      if (name.starts_with("spine")) {
        takes_.push_back(Along({"pelvis", "spine1", "spine2", "spine3"}, ++spine, spines));
      } else if (name.starts_with("neck")) {
        takes_.push_back(Along({"neck", "head"}, neck++, necks));
      } else {
        takes_.push_back({Smpl().Find(name), Smpl().Find(name), 0});
      }
    }
  }

  Eigen::Matrix3d Of(int joint, const JointPlacement& smpl) const {
    const Take& take = takes_[joint];
    return take.share == 0
               ? smpl.rotations[take.from]
               : SlerpMatrix(smpl.rotations[take.from], smpl.rotations[take.to], take.share);
  }

 private:
  struct Take {
    int from, to;
    double share;
  };
  // The rotation at `part` / `parts` of the way along a chain.
  static Take Along(const std::vector<std::string>& chain, int part, int parts) {
    const double way = static_cast<double>(part) * static_cast<double>(chain.size() - 1) / parts;
    const auto below = static_cast<size_t>(way);
    const size_t above = std::min(below + 1, chain.size() - 1);
    return {Smpl().Find(chain[below]), Smpl().Find(chain[above]), way - std::floor(way)};
  }

  std::vector<Take> takes_;
};

using HandShifts = Eigen::Matrix<double, 3, 2>;  // left, right

// Smoothed over neighbouring frames by a Gaussian.
std::vector<HandShifts> Smooth(const std::vector<HandShifts>& ways, double fps) {
  const double sigma = kDraws * fps;
  const int reach = static_cast<int>(3 * sigma);
  const int frames = static_cast<int>(ways.size());
  std::vector<HandShifts> smooth;
  for (int frame = 0; frame < frames; ++frame) {
    smooth.push_back(GaussianMean<HandShifts>(
        std::max(0, frame - reach), std::min(frames - 1, frame + reach), frame,
        std::max(sigma, 1e-9), HandShifts::Zero(), [&](int64_t at) { return ways[at]; }));
  }
  return smooth;
}

/// Moves hands to SMPL's positions relative to what they touch.
class Hands {
 public:
  Hands(const Skeleton& character, double size)
      : character_(character),
        size_(size),
        arms_{{character.left_shoulder, character.left_elbow, character.Find("left_wrist")},
              {character.right_shoulder, character.right_elbow, character.Find("right_wrist")}} {
    for (const Hinge& hinge : Hinges(character)) {
      for (size_t side = 0; side < 2; ++side) {
        if (hinge.joint == arms_[side].middle) hinges_[side] = hinge.axis;
      }
    }
    for (const char* anchor : {"head", "left_hip", "right_hip", "left_knee", "right_knee"}) {
      if (character.Find(anchor) >= 0)
        anchors_.push_back({Smpl().Find(anchor), character.Find(anchor)});
    }
  }

  /// The displacement of each hand from `now`, metres.
  HandShifts Shifts(const Eigen::Matrix3Xd& smpl, const Eigen::Matrix3Xd& now) const {
    return (HandShifts() << HandShift(0, smpl, now), HandShift(1, smpl, now)).finished();
  }

  void Move(const HandShifts& ways, const JointPlacement& placement, Pose* pose) const {
    for (size_t side = 0; side < 2; ++side) {
      const Limb& arm = arms_[side];
      const Eigen::Vector3d way = ways.col(side);
      if (way.norm() < kNoWay * size_) continue;
      const Eigen::Vector3d hinge = placement.rotations[arm.upper] * hinges_[side];
      const Eigen::Vector3d goal =
          Col(placement.positions, arm.end) + way - Col(placement.positions, arm.upper);
      PlaceEnd(arm, hinge, character_, placement, goal, pose);
    }
  }

 private:
  struct Anchor {
    int ours, theirs;
  };

  // 1 where a hand touches, 0 where it is free, smooth in between.
  static double Nearness(double distance) {
    return SmoothStep(std::clamp((kFree - distance) / (kFree - kTouches), 0.0, 1.0));
  }

  Eigen::Vector3d HandShift(size_t side, const Eigen::Matrix3Xd& smpl,
                            const Eigen::Matrix3Xd& now) const {
    const Eigen::Vector3d our_hand = Col(smpl, ours_[side]), hand = Col(now, arms_[side].end);
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    double weights = 0;
    const auto draw = [&](const Eigen::Vector3d& goal, double weight) {
      way += weight * (goal - hand);
      weights += weight;
    };
    // Hands that touch meet in their middle, so each moves half of the way.
    const Eigen::Vector3d apart = our_hand - Col(smpl, ours_[1 - side]);
    const Eigen::Vector3d middle = (hand + Col(now, arms_[1 - side].end)) / 2;
    draw(middle + size_ * apart / 2, Nearness(apart.norm()));
    for (const Anchor& anchor : anchors_) {
      const Eigen::Vector3d from = our_hand - Col(smpl, anchor.ours);
      draw(Col(now, anchor.theirs) + size_ * from, Nearness(from.norm()));
    }
    draw({hand.x(), size_ * our_hand.y(), hand.z()}, Nearness(our_hand.y()));
    return way / std::max(1.0, weights);
  }

  const Skeleton& character_;
  const double size_;
  const int ours_[2] = {Smpl().Find("left_wrist"), Smpl().Find("right_wrist")};
  const Limb arms_[2];
  Eigen::Vector3d hinges_[2];
  std::vector<Anchor> anchors_;
};

}  // namespace

double CharacterSize(const Skeleton& character) { return LegHeight(character) / LegHeight(Smpl()); }

Motion CopyTurns(const Motion& smpl, const Skeleton& character) {
  const double size = CharacterSize(character);
  const Takes takes(character);
  const Eigen::Vector3d our_rest = MiddleOfHips(Smpl(), JointPositions(Smpl(), RestPose(Smpl())));
  const Eigen::Vector3d rest =
      MiddleOfHips(character, JointPositions(character, RestPose(character)));
  Motion out{.fps = smpl.fps, .frames = {}};
  for (const Pose& pose : smpl.frames) {
    const JointPlacement ours = ForwardKinematics(Smpl(), pose);
    Pose& copied = out.frames.emplace_back();
    copied.rotations.resize(3, character.joints());
    std::vector<Eigen::Matrix3d> turned;
    for (int joint = 0; joint < character.joints(); ++joint) {
      turned.push_back(takes.Of(joint, ours));
      const int parent = character.parents[joint];
      copied.rotations.col(joint) = LogMap(
          parent < 0 ? turned.back() : Eigen::Matrix3d(turned[parent].transpose() * turned.back()));
    }
    Eigen::Vector3d hips = size * MiddleOfHips(Smpl(), ours.positions);
    hips.y() += rest.y() - size * our_rest.y();
    copied.root_position = hips - MiddleOfHips(character, JointPositions(character, copied));
  }
  MakeContinuous(out);
  return out;
}

Motion PlaceLimbs(const Motion& smpl, const Skeleton& character, Motion copied) {
  const double size = CharacterSize(character);
  const Eigen::Matrix3Xd our_rest = JointPositions(Smpl(), RestPose(Smpl()));
  const Eigen::Matrix3Xd rest = JointPositions(character, RestPose(character));
  const std::array<Leg, 2> our_legs = Leg::Of(Smpl()), legs = Leg::Of(character);
  const Hands hands(character, size);
  JointPlacement placement;
  std::vector<HandShifts> ways;
  for (size_t frame = 0; frame < copied.frames.size(); ++frame) {
    const Eigen::Matrix3Xd ours = JointPositions(Smpl(), smpl.frames[frame]);
    Pose& pose = copied.frames[frame];
    ForwardKinematics(character, pose, placement);
    for (size_t side = 0; side < 2; ++side) {
      Eigen::Vector3d toes = size * ours.col(our_legs[side].toes);
      toes.y() += rest(1, legs[side].toes) - size * our_rest(1, our_legs[side].toes);
      PlaceToes(legs[side], character, placement, toes, &pose);
    }
    // Hands on knees follow the knees' present place.
    ways.push_back(hands.Shifts(ours, JointPositions(character, pose)));
  }
  ways = Smooth(ways, smpl.fps);
  for (size_t frame = 0; frame < copied.frames.size(); ++frame) {
    ForwardKinematics(character, copied.frames[frame], placement);
    hands.Move(ways[frame], placement, &copied.frames[frame]);
  }
  MakeContinuous(copied);
  return copied;
}

Motion TransferToCharacter(const Motion& smpl, const Skeleton& character) {
  return PlaceLimbs(smpl, character, CopyTurns(smpl, character));
}

}  // namespace choreo
