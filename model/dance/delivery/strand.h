#pragma once

#include <mutex>
#include <utility>

namespace choreo {

/// Takes steps one at a time, from any number of threads. The first thread in Run takes them all:
/// other threads return at once, and it takes their steps, too. Guarded by its owner's mutex.
class Strand {
 public:
  /// Takes at most `most` steps. `next`, called under `mutex`, returns the next step, or a false
  /// value if there is none. `take`, called without `mutex`, gets each step, including the final
  /// false value, and may call the owner back. Returns whether more may be left. If `take` throws,
  /// the exception propagates and remaining steps wait for the next call.
  bool Run(std::mutex& mutex, int most, const auto& next, const auto& take) {
    std::unique_lock lock(mutex);
    looks_again_ = true;
    if (std::exchange(runs_, true)) return false;
    try {
      for (int taken = 0; taken < most && looks_again_; ++taken) {
        auto step = next();
        looks_again_ = static_cast<bool>(step);
        lock.unlock();
        take(std::move(step));
        lock.lock();
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      runs_ = false;
      throw;
    }
    runs_ = false;
    return looks_again_;
  }

 private:
  bool runs_ = false, looks_again_ = false;
};

}  // namespace choreo
