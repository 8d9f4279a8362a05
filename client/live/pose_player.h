#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "model/motion/motion.h"

namespace choreo::live {

/// Shows the frames of a dance when their time has come, on a thread of its own. Frames that come
/// late are shown at once. Thread-safe.
class PosePlayer {
 public:
  using Clock = std::chrono::steady_clock;
  /// `seconds` of the dance; called in the frames' order.
  using Show = std::function<void(const Pose& pose, double seconds)>;

  /// Frame f is shown f / `fps` seconds after `start`.
  PosePlayer(double fps, Clock::time_point start, Show show);
  ~PosePlayer();  ///< what has not been shown yet, is not
  PosePlayer(const PosePlayer&) = delete;
  PosePlayer& operator=(const PosePlayer&) = delete;

  void Push(int64_t first_frame, std::span<const Pose> poses);
  Clock::time_point Due(int64_t frame) const;
  /// Whether all that was pushed is shown, if need be after `patience`.
  bool Shown(std::chrono::milliseconds patience = std::chrono::milliseconds(50));

 private:
  void Play();

  const double fps_;
  const Clock::time_point start_;
  const Show show_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<std::pair<int64_t, Pose>> waiting_;  // the one that is being shown, too
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace choreo::live
