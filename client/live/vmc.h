#pragma once

#include <memory>
#include <string>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::live {

/// Sends poses to VTuber programs and game engines by VMC (Virtual Motion Capture protocol). This
/// is OSC over UDP: one bundle per frame with /VMC/Ext/OK, /VMC/Ext/T, /VMC/Ext/Root/Pos and a
/// /VMC/Ext/Bone/Pos for each bone, by VRM's names. The root is the point on the floor below the
/// hips, without rotation; the hips have their height and rotation. VMC is left-handed, so x is
/// mirrored. The skeleton's rest pose counts as VRM's T-pose. Not thread-safe.
class VmcSender {
 public:
  /// `address`: HOST:PORT. UDP does not tell whether anybody listens. Throws
  /// Error(kInvalidArgument), whose field is --vmc, for a malformed address or an unknown host, and
  /// as Skeleton::RequireRoles does for a body without limbs.
  VmcSender(const std::string& address, const Skeleton& skeleton);
  ~VmcSender();
  VmcSender(const VmcSender&) = delete;
  VmcSender& operator=(const VmcSender&) = delete;

  /// Sends a pose. `seconds`: its time in the dance.
  void Send(const Pose& pose, double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo::live
