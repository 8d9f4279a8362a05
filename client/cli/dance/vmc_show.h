#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "client/choreo_client.h"
#include "client/live/pose_player.h"
#include "client/live/vmc.h"

namespace choreo::cli {

/// `--vmc` for dances generated faster than real time: streams a dance in real time from its first
/// frame on.
class VmcShow {
 public:
  /// Throws as VmcSender does.
  VmcShow(const std::string& address, const Skeleton& skeleton) : sender_(address, skeleton) {}

  /// Adds the next message of the dance.
  void Add(const client::Message& message);
  /// Whether the last received frame has been sent. Waits a moment if not.
  bool Over() { return !player_ || player_->Shown(); }

 private:
  live::VmcSender sender_;
  double fps_ = 0;
  std::unique_ptr<live::PosePlayer> player_;
};

}  // namespace choreo::cli
