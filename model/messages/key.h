#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "model/core/hand_pose.h"
#include "model/motion/motion.h"

namespace choreo {

/// When a key is due. Times round to the nearest frame; the frame and its time are reported with
/// the key.
struct AtFrame {
  int64_t frame = 0;  ///< absolute, frame 0 at time 0
};
struct AtTime {
  double seconds = 0;  ///< absolute
};
/// Frames after the key of the previous keyframe message; for the first message, after frame 0.
struct AfterPrevious {
  int64_t frames = 0;
};
using KeyMoment = std::variant<AtFrame, AtTime, AfterPrevious>;

/// A key pose at a frame. World frame.
struct Key {
  std::string id = {};
  int64_t frame = 0;
  Pose pose = {};
  PoseMask mask = {};
  /// How hard the dancer hits it, 0 to kMaxHit (model/core/hit.h), coming to rest in it. None: the
  /// dance passes through it.
  std::optional<double> hit = {};
  std::optional<HandPose> hands = {};  ///< KeyReached::hands

  /// Whether both give the same dance. Ignores the hands.
  bool IsDancedAs(const Key& other) const {
    return id == other.id && frame == other.frame &&
           pose.root_position == other.pose.root_position &&
           pose.rotations == other.pose.rotations &&
           mask.root_position == other.mask.root_position && mask.joints == other.mask.joints &&
           hit == other.hit;
  }
};

}  // namespace choreo
