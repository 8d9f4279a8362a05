#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/character_body.h"
#include "model/fit/rig_motion.h"

/// The facts that a recording reveals about its rig before fitting. Private to this folder.
namespace choreo {

/// The share of frames that makes a rule.
inline constexpr double kRuleShare = 0.9;

/// The bones whose direction is that to their end: by SMPL's names, which HumanBones uses, too.
struct LimbSegment {
  std::string from, to;
};
/// The left side's bones, then as many of the right.
const std::vector<LimbSegment>& LimbSegments();

/// Samples a few frames; the recording must outlive it.
class RigReading {
 public:
  /// Fails like FitRig.
  explicit RigReading(const RigMotion& rig);

  const RigMotion& rig() const { return rig_; }
  int Find(const std::string& bone) const { return rig_.bones.Find(bone); }
  Eigen::Vector3d Bone(const RigPlacement& placement, const LimbSegment& segment) const;

  /// Our legs' length over the rig's.
  double Scale() const;
  /// RigFit::missing.
  std::vector<std::string> Missing() const;
  /// Whether the positions of bones' ends turn with the bones: always, unless joints were moved
  /// without turning anything.
  bool TurnsCarry() const;

  /// A rest pose that is a standing body.
  struct Rest {
    CharacterBody body;
    const RigPlacement* placement = nullptr;
  };
  /// The best of the file's rest poses; without a usable one, the first frame that stands with
  /// straight limbs and arms held out.
  std::optional<Rest> FindRest() const;
  /// Whether one of the file's rest poses stands.
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
