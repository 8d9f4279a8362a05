#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "model/core/error.h"
#include "model/dance/delivery/strand.h"

namespace choreo {

/// Queues calls to a listener and makes them one at a time, in the order of Post, without a lock.
/// The first thread in Deliver makes the calls, and other threads do not wait, so the listener may
/// call its caller back. Drops posts after the last call. Thread-safe.
template <typename Listener>
class Mailbox {
 public:
  explicit Mailbox(std::shared_ptr<Listener> listener) : listener_(std::move(listener)) {}

  using Call = std::function<void(Listener&)>;

  void Post(Call call) { Add(std::move(call), /*last=*/false); }
  void PostLast(Call call) { Add(std::move(call), /*last=*/true); }
  /// Posts OnError as the last call.
  void PostError(const Error& error) {
    PostLast([error](Listener& listener) { listener.OnError(error); });
  }
  /// Whether the last call has been posted.
  bool over() const {
    std::lock_guard lock(mutex_);
    return over_;
  }

  /// Makes the waiting calls. If one throws, the exception propagates and the others wait for the
  /// next Deliver.
  void Deliver() {
    strand_.Run(
        mutex_, std::numeric_limits<int>::max(), [this] { return TakeNext(); },
        [this](Call call) {
          if (call) call(*listener_);
        });
  }

  /// Drops waiting calls and makes OnError the last call. For use when memory is exhausted:
  /// allocates nothing. If the listener's own allocation fails, the call is lost.
  void GiveUp() noexcept {
    {
      std::lock_guard lock(mutex_);
      if (gave_up_) return;
      over_ = gave_up_ = last_words_ = true;
      calls_.clear();
    }
    try {
      Deliver();
    } catch (...) {
    }
  }

 private:
  // Requires mutex_.
  Call TakeNext() {
    if (!calls_.empty()) {
      Call next = std::move(calls_.front());
      calls_.pop_front();
      return next;
    }
    if (!std::exchange(last_words_, false)) return {};
    return [this](Listener& listener) { listener.OnError(failure_); };
  }

  void Add(Call call, bool last) {
    std::lock_guard lock(mutex_);
    if (over_) return;
    calls_.push_back(std::move(call));
    over_ = last;
  }

  const std::shared_ptr<Listener> listener_;
  const Error failure_{ErrorCode::kInternal, "",
                       "the dance cannot continue; the server may be out of memory"};
  mutable std::mutex mutex_;
  Strand strand_;
  std::deque<Call> calls_;
  bool over_ = false;
  bool gave_up_ = false;
  bool last_words_ = false;
};

}  // namespace choreo
