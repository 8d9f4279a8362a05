#include "model/fit/bones/finger_bones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr size_t kThumb = 0, kHandFingers = 5, kBentBones = 3;  // bones of a finger that bend
constexpr double kNoDirection = 1e-6;  // share of the hand: a shorter vector has no direction

// The names of the fingers, from the thumb to the little finger, in English and as MMD spells them.
constexpr std::array<std::array<std::string_view, 3>, kHandFingers> kFingerNames = {
    {{"thumb", "親指", "親指"},
     {"index", "人指", "人差指"},
     {"mid", "中指", "中指"},
     {"ring", "薬指", "薬指"},
     {"pinky", "little", "小指"}}};

/// The bend of each bone of each finger against the bone before it, degrees.
using Bends = std::array<std::array<double, kBentBones>, kHandFingers>;
constexpr std::array<Bends, kHandPoseNames.size()> kBends = {{
    {},
    {{{8, 12, 15}, {18, 25, 15}, {24, 30, 18}, {28, 34, 20}, {32, 36, 22}}},
    {{{0, 0, 0}, {0, 3, 2}, {0, 3, 2}, {0, 3, 2}, {0, 3, 2}}},
    {{{25, 35, 45}, {82, 98, 60}, {84, 100, 62}, {86, 100, 62}, {88, 98, 60}}},
    {{{25, 35, 45}, {2, 4, 2}, {84, 100, 62}, {86, 100, 62}, {88, 98, 60}}},
}};

std::string Lower(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// The nodes of each finger, from the knuckle on.
using Hand = std::array<std::vector<int>, kHandFingers>;

Hand FindFingers(const RigNodes& rig, int wrist) {
  std::vector<int> below;
  for (int node = 0; node < static_cast<int>(rig.names.size()); ++node)
    if (node != wrist && !rig.meshes[node] && IsBelow(node, wrist, rig.parents))
      below.push_back(node);
  const auto depth = [&](int node) {
    int steps = 0;
    for (; node != wrist; node = rig.parents[node]) ++steps;
    return steps;
  };
  std::ranges::stable_sort(below, {}, depth);
  Hand hand;
  for (const int node : below) {
    const std::string name = Lower(rig.names[node]);
    for (size_t finger = 0; finger < kHandFingers; ++finger) {
      const bool is_its = std::ranges::any_of(kFingerNames[finger], [&](std::string_view token) {
        return name.find(token) != std::string::npos;
      });
      std::vector<int>& chain = hand[finger];
      if (!is_its || (finger != kThumb && name.find("metacarpal") != std::string::npos)) continue;
      // Skips twist and correction nodes beside the bones.
      if (chain.empty() || IsBelow(node, chain.back(), rig.parents)) chain.push_back(node);
      break;
    }
  }
  return hand;
}

class HandCurl {
 public:
  HandCurl(const RigNodes& rig, int wrist, bool is_left, HandPose pose)
      : rig_(rig),
        wrist_(rig.places.col(wrist)),
        hand_(FindFingers(rig, wrist)),
        bends_(kBends[static_cast<size_t>(pose)]) {
    // The direction across the hand: from the last finger to the first, or to the thumb.
    std::vector<Vector3d> knuckles;
    for (size_t finger = 1; finger < kHandFingers; ++finger)
      if (!hand_[finger].empty()) knuckles.push_back(Place(hand_[finger].front()));
    if (knuckles.empty()) return;
    if (knuckles.size() == 1 && hand_[kThumb].empty()) return;
    const Vector3d first = knuckles.size() > 1 ? knuckles.front() : Place(hand_[kThumb].front());
    for (const Vector3d& knuckle : knuckles)
      middle_ += knuckle / static_cast<double>(knuckles.size());
    const Vector3d ahead = middle_ - wrist_, across = first - knuckles.back();
    palm_ = is_left ? ahead.cross(across) : across.cross(ahead);
    size_ = ahead.norm();
    if (palm_.norm() > kNoDirection * size_ * size_)
      palm_.normalize();
    else
      size_ = 0;
  }

  void AddTo(std::vector<CurledBone>* curled) const {
    if (!(size_ > 0)) return;
    for (size_t finger = 1; finger < kHandFingers; ++finger) Bend(finger, palm_, curled);
    if (hand_[kThumb].empty()) return;
    // The thumb turns towards a point in front of the fingers' knuckles.
    const Vector3d before = middle_ + 0.35 * size_ * palm_ - Place(hand_[kThumb].front());
    if (before.norm() > kNoDirection * size_) Bend(kThumb, before.normalized(), curled);
  }

 private:
  Vector3d Place(int node) const { return rig_.places.col(node); }

  // Bends a finger towards a direction, about one axis.
  void Bend(size_t finger, const Vector3d& towards, std::vector<CurledBone>* curled) const {
    const std::vector<int>& chain = hand_[finger];
    if (chain.size() < 2) return;
    const Vector3d first = Place(chain[1]) - Place(chain[0]);
    Vector3d axis = first.cross(towards);
    if (!(axis.norm() > 0.1 * first.norm())) axis = (middle_ - wrist_).cross(palm_);
    if (!(axis.norm() > 0)) return;
    axis.normalize();
    Vector3d before = first;
    for (size_t bone = 0; bone < std::min(chain.size(), kBentBones); ++bone) {
      // A last node without an end continues in the direction of the bone before it.
      const Vector3d along =
          bone + 1 < chain.size() ? Vector3d(Place(chain[bone + 1]) - Place(chain[bone])) : before;
      const double rests = std::atan2(axis.dot(before.cross(along)), before.dot(along));
      const double bend = bends_[finger][bone] * kDegree - rests;
      if (bend != 0) curled->push_back({chain[bone], axis, {bend}});
      before = along;
    }
  }

  const RigNodes& rig_;
  const Vector3d wrist_;
  const Hand hand_;
  const Bends& bends_;
  Vector3d middle_ = Vector3d::Zero();  // of the knuckles
  Vector3d palm_ = Vector3d::Zero();    // out of the palm
  double size_ = 0;                     // from the wrist to the knuckles; 0: unknown
};

}  // namespace

std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones, HandPose pose) {
  std::vector<CurledBone> curled;
  if (pose == HandPose::kRest) return curled;
  for (const char* side : {"left_", "right_"}) {
    const int wrist = bones.Find(std::string(side) + "wrist");
    if (wrist < 0) continue;
    HandCurl(rig, wrist, side == std::string("left_"), pose).AddTo(&curled);
  }
  return curled;
}

std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones,
                                    const std::vector<HandKey>& keys, int64_t frames, double fps) {
  std::map<int, CurledBone> curled;  // by node
  for (size_t i = 0; i < keys.size(); ++i) {
    for (CurledBone& bone : CurlFingers(rig, bones, keys[i].pose)) {
      const double angle = std::exchange(bone.angles, {}).front();
      auto& own = curled.try_emplace(bone.node, std::move(bone)).first->second;
      own.angles.resize(keys.size());  // 0, straight, for poses that do not bend the bone
      own.angles[i] = angle;
    }
  }
  std::vector<CurledBone> moved;
  for (auto& [node, bone] : curled) {
    std::vector<double> angles;
    for (int64_t frame = 0; frame < frames; ++frame) {
      const double time = static_cast<double>(frame) / fps;
      const auto next = std::ranges::upper_bound(keys, time, {}, &HandKey::time_s);
      const auto after = static_cast<size_t>(next - keys.begin());
      const size_t before = after == 0 ? 0 : after - 1;
      const double from = bone.angles[before];
      if (after == 0 || after == keys.size()) {
        angles.push_back(from);
        continue;
      }
      const double t = (time - keys[before].time_s) / (next->time_s - keys[before].time_s);
      angles.push_back(from + SmoothStep(t) * (bone.angles[after] - from));
    }
    bone.angles = std::move(angles);
    moved.push_back(std::move(bone));
  }
  return moved;
}

}  // namespace choreo
