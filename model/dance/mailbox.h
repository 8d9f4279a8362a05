#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace choreo {

/// Calls to a listener, made one at a time and in the order of Post, with no lock held, by
/// whichever thread comes to Deliver first; the others go on at once. So a listener may call back
/// what calls it. Thread-safe.
template <typename Listener>
class Mailbox {
 public:
  explicit Mailbox(std::shared_ptr<Listener> listener) : listener_(std::move(listener)) {}

  void Post(std::function<void(Listener&)> call) {
    std::lock_guard lock(mutex_);
    calls_.push_back(std::move(call));
  }

  void Deliver() {
    std::unique_lock lock(mutex_);
    if (delivering_) return;
    delivering_ = true;
    while (!calls_.empty()) {
      const std::function<void(Listener&)> call = std::move(calls_.front());
      calls_.pop_front();
      lock.unlock();
      call(*listener_);
      lock.lock();
    }
    delivering_ = false;
  }

 private:
  const std::shared_ptr<Listener> listener_;
  std::mutex mutex_;
  std::deque<std::function<void(Listener&)>> calls_;
  bool delivering_ = false;
};

}  // namespace choreo
