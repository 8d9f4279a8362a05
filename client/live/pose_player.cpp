#include "client/live/pose_player.h"

namespace choreo::live {

PosePlayer::PosePlayer(double fps, Clock::time_point start, Show show)
    : fps_(fps), start_(start), show_(std::move(show)), thread_([this] { Play(); }) {}

PosePlayer::~PosePlayer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PosePlayer::Push(int64_t first_frame, std::span<const Pose> poses) {
  {
    const std::lock_guard lock(mutex_);
    for (const Pose& pose : poses) waiting_.emplace_back(first_frame++, pose);
  }
  changed_.notify_all();
}

PosePlayer::Clock::time_point PosePlayer::Due(int64_t frame) const {
  const std::chrono::duration<double> since(static_cast<double>(frame) / fps_);
  return start_ + std::chrono::duration_cast<Clock::duration>(since);
}

bool PosePlayer::Shown(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [this] { return waiting_.empty(); });
}

void PosePlayer::Play() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    // Only this thread removes the first frame; Push appends.
    const auto& [frame, pose] = waiting_.front();
    if (changed_.wait_until(lock, Due(frame), [this] { return stop_; })) return;
    lock.unlock();
    show_(pose, static_cast<double>(frame) / fps_);
    lock.lock();
    waiting_.pop_front();
    changed_.notify_all();
  }
}

}  // namespace choreo::live
