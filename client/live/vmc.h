#pragma once

#include <memory>
#include <string>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::live {

/// Sends poses by VMC (Virtual Motion Capture protocol) to VTuber programs and game engines: OSC
/// over UDP, one bundle per frame with /VMC/Ext/OK, /VMC/Ext/T, /VMC/Ext/Root/Pos and a
/// /VMC/Ext/Bone/Pos for each bone, by VRM's names. The root is the hips' floor position, unturned;
/// the hips have their height and rotation. VMC is left-handed, so x is mirrored. The skeleton's
/// rest pose counts as VRM's T-pose. Not thread-safe.
class VmcSender {
 public:
  /// `address`: HOST:PORT. UDP does not tell whether anybody listens. Throws
  /// Error(kInvalidArgument), whose field is --vmc, for a malformed address or a host without one,
  /// and as Skeleton::RequireRoles for a body without limbs.
  VmcSender(const std::string& address, const Skeleton& skeleton);
  ~VmcSender();
  VmcSender(const VmcSender&) = delete;
  VmcSender& operator=(const VmcSender&) = delete;

  /// `seconds`: of the dance.
  void Send(const Pose& pose, double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo::live
