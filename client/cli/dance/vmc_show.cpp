#include "client/cli/dance/vmc_show.h"

#include <variant>

namespace choreo::cli {

void VmcShow::Add(const client::Message& message) {
  if (const auto* header = std::get_if<client::Header>(&message)) fps_ = header->fps;
  const auto* block = std::get_if<client::FrameBlock>(&message);
  if (!block) return;
  if (!player_) {
    player_ = std::make_unique<live::PosePlayer>(
        fps_, live::PosePlayer::Clock::now(),
        [this](const Pose& pose, double seconds) { sender_.Send(pose, seconds); });
  }
  player_->Push(block->first_frame, block->poses);
}

}  // namespace choreo::cli
