#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/bones/character_body.h"
#include "model/fit/rig_motion.h"

/// Works out from a recording what its rig's rest pose and rotations mean, before fitting. Private
/// to this folder.
namespace choreo {

/// Something true in this share of frames counts as a rule.
inline constexpr double kRuleShare = 0.9;

/// A limb's bone: the joints at its two ends, by their names in SMPL and HumanBones.
struct LimbSegment {
  std::string from, to;
};
/// The left side's bones, followed by the right side's in the same order.
const std::vector<LimbSegment>& LimbSegments();

/// Analyses a recording by a sample of its frames. The recording must outlive it.
class RigReading {
 public:
  /// Throws what FitRig throws.
  explicit RigReading(const RigMotion& rig);

  const RigMotion& rig() const { return rig_; }
  int Find(const std::string& bone) const { return rig_.bones.Find(bone); }
  Eigen::Vector3d Bone(const RigPlacement& placement, const LimbSegment& segment) const;

  /// Our legs' length over the rig's.
  double Scale() const;
  /// RigFit::missing.
  std::vector<std::string> Missing() const;
  /// Whether the ends of bones move with the bones' rotations. False for files that move joints
  /// without rotating them.
  bool TurnsCarry() const;

  /// A rest pose that is a standing body.
  struct Rest {
    CharacterBody body;
    const RigPlacement* placement = nullptr;
  };
  /// The best of the file's rest poses, or else the first frame that stands with straight limbs and
  /// arms held out.
  std::optional<Rest> FindRest() const;
  /// Whether one of the file's rest poses is a standing body.
  bool Stands() const;
  /// RigFit::up.
  std::optional<Eigen::Vector3d> Up() const;

 private:
  Eigen::Vector3d Inside(const RigPlacement& placement, const LimbSegment& segment) const;
  bool Point(const std::function<Eigen::Vector3d(const LimbSegment&)>& expected,
             double share) const;
  bool Agrees(const RigPlacement& rest) const;
  bool IsHeldOut(const RigPlacement& placement) const;

  const RigMotion& rig_;
  std::vector<RigPlacement> samples_;
};

}  // namespace choreo
