#pragma once

#include <memory>
#include <string>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::live {

/// Sends poses as VMC (Virtual Motion Capture protocol), the way VTuber programs and game engines
/// listen: OSC over UDP, one bundle a frame with /VMC/Ext/OK, /VMC/Ext/T, /VMC/Ext/Root/Pos and a
/// /VMC/Ext/Bone/Pos for each bone, by VRM's names. The root is where the hips are on the floor,
/// unturned; the hips have their height and turn. VMC is left-handed, so what it shows is turned
/// over in x. The skeleton at rest is taken for VRM's T-pose. Not thread-safe.
class VmcSender {
 public:
  /// `address`: HOST:PORT. Whether anybody listens there is not known. Throws
  /// Error(kInvalidArgument) whose field is --vmc where it is none or its host has no address, and
  /// as Skeleton::RequireRoles for a body without limbs.
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
