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

/// Shows a dance's frames at their times, on its own thread. Shows late frames immediately.
/// Thread-safe.
class PosePlayer {
 public:
  using Clock = std::chrono::steady_clock;
  /// Shows a pose at a second of the dance. Called in the order of frames.
  using Show = std::function<void(const Pose& pose, double seconds)>;

  /// Shows frame f at f / `fps` seconds after `start`.
  PosePlayer(double fps, Clock::time_point start, Show show);
  ~PosePlayer();  ///< drops frames not yet shown
  PosePlayer(const PosePlayer&) = delete;
  PosePlayer& operator=(const PosePlayer&) = delete;

  void Push(int64_t first_frame, std::span<const Pose> poses);
  Clock::time_point Due(int64_t frame) const;
  /// Whether all pushed frames have been shown. Waits for at most `patience`.
  bool Shown(std::chrono::milliseconds patience = std::chrono::milliseconds(50));

 private:
  void Play();

  const double fps_;
  const Clock::time_point start_;
  const Show show_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<std::pair<int64_t, Pose>> waiting_;  // includes the one being shown
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace choreo::live
