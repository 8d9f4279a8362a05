#pragma once

#include <grpcpp/support/status.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "model/dance/delivery/strand.h"
#include "server/calls/call_registry.h"

namespace choreo {

/// Connects the producers of a call's answers (workers) with the gRPC reactor that writes them.
///
/// In gRPC 1.51, server reactors have no holds: a reactor is destroyed once it has finished and its
/// operations are over. So only this object starts writes and finishes, always under the lock, and
/// starts nothing after Finish. Workers keep this object alive, not the reactor.
///
/// Back-pressure bounds the queue. The dance pauses when the queue exceeds `max_bytes`, and resumes
/// when it falls to half as much. Waiting frames are joined into larger messages. While the queue
/// exceeds kMaxWaiting times `max_bytes`, the client's messages are not read. Thread-safe.
template <class Response>
class Outbox {
 public:
  /// Frames alone do not reach this limit, so a client may send all its messages before it reads
  /// any answer.
  static constexpr size_t kMaxWaiting = 4;

  /// The reactor's operations. The outbox calls them with its lock held; they must not call it.
  class Wire {
   public:
    virtual ~Wire() = default;
    virtual void Write(const Response* message) = 0;  ///< OnWriteDone follows
    virtual void Finish(const grpc::Status& status) = 0;
    virtual void Read() {}  ///< reads the client's next message; only after RequestRead
    /// Ends the call with `status`, regardless of the client; OnWriteDone follows soon.
    virtual void Reset(const grpc::Status& /*status*/) {}
  };

  enum class State {
    kOpen,      ///< accepts answers
    kClosing,   ///< accepts no answers, but sends queued ones
    kFinished,  ///< Wire::Finish was called, so the wire may be destroyed
  };

  /// Delays Wire::Finish while it exists. Needed to use the reactor without the lock.
  class Hold {
   public:
    explicit Hold(Outbox& outbox) : outbox_(outbox) {
      const std::lock_guard lock(outbox_.mutex_);
      ++outbox_.holds_;
    }
    ~Hold() {
      const std::lock_guard lock(outbox_.mutex_);
      --outbox_.holds_;
      outbox_.Advance();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Outbox& outbox_;
  };

  using Clock = std::chrono::steady_clock;

  /// `set_paused` and `on_sent` are called without the lock, one call at a time. `on_sent` gets
  /// each sent answer and the time at which its first part was queued. `time` must outlive this.
  Outbox(Wire* wire, size_t max_bytes, std::function<void(bool)> set_paused,
         std::function<void(const Response&, Clock::time_point)> on_sent = {},
         const TimeSource& time = TimeSource::System())
      : wire_(wire),
        max_bytes_(max_bytes),
        set_paused_(std::move(set_paused)),
        on_sent_(std::move(on_sent)),
        time_(time) {}

  /// Queues an answer. Does nothing unless open.
  void Send(Response message) {
    {
      const std::lock_guard lock(mutex_);
      if (state_ != State::kOpen) return;
      const size_t bytes = message.ByteSizeLong();
      bytes_ += bytes;
      if (!Join(message, bytes)) queue_.push_back({std::move(message), bytes, Clock::now()});
      Advance();
    }
    UpdatePressure();
  }

  /// Ends the call with `status`. Only the first End sets the status; a later one may end the call
  /// sooner.
  void End(const grpc::Status& status, Ending ending) {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kFinished) return;
    if (state_ == State::kOpen) status_ = status;
    state_ = State::kClosing;
    while (ending != Ending::kAfterQueued && queue_.size() > (writing_ ? 1 : 0)) {
      bytes_ -= queue_.back().bytes;
      queue_.pop_back();
    }
    if (ending == Ending::kNow && writing_) wire_->Reset(status_);
    Advance();
  }

  /// Call when the reactor has handled the client's last message. Starts reading the next one as
  /// soon as there is room for its answer, unless the call ends first.
  void RequestRead() {
    const std::lock_guard lock(mutex_);
    read_at_ = time_.Now();
    read_wanted_ = true;
    Advance();
  }

  /// Call from the reactor's OnWriteDone.
  void OnWriteDone(bool ok) {
    Item done;
    {
      const std::lock_guard lock(mutex_);
      writing_ = false;
      written_at_ = time_.Now();
      done = std::move(queue_.front());
      bytes_ -= done.bytes;
      queue_.pop_front();
    }
    if (ok) {
      if (on_sent_) on_sent_(done.message, done.queued);
      {
        const std::lock_guard lock(mutex_);
        Advance();
      }
      UpdatePressure();
    } else {
      End({grpc::StatusCode::CANCELLED, "the client is gone"}, Ending::kAfterCurrent);
    }
  }

  /// Whether an answer is waiting for the client to take it, and since when; otherwise the time of
  /// the last message in either direction.
  CallProgress progress() const {
    const std::lock_guard lock(mutex_);
    return {writing_, writing_ ? written_at_ : std::max(written_at_, read_at_)};
  }

  bool open() const {
    const std::lock_guard lock(mutex_);
    return state_ == State::kOpen;
  }

  /// The status with which the call has ended or will end.
  grpc::Status status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  static constexpr int kMaxJoinedFrames = 60;

  struct Item {
    Response message;
    size_t bytes = 0;
    Clock::time_point queued = {};
  };

  // Appends frames to the last waiting message if they directly follow its frames.
  bool Join(const Response& message, size_t bytes) {
    if (!message.has_frames() || queue_.size() < (writing_ ? 2U : 1U)) return false;
    Item& last = queue_.back();
    if (!last.message.has_frames()) return false;
    const auto& next = message.frames();
    auto* frames = last.message.mutable_frames();
    if (frames->candidate() != next.candidate() ||
        frames->first_frame() + frames->count() != next.first_frame() ||
        frames->count() + next.count() > kMaxJoinedFrames) {
      return false;
    }
    frames->set_count(frames->count() + next.count());
    frames->mutable_root_positions()->MergeFrom(next.root_positions());
    frames->mutable_rotations()->MergeFrom(next.rotations());
    frames->mutable_contacts()->MergeFrom(next.contacts());
    last.bytes += bytes;
    return true;
  }

  // Starts the operations that are due. Requires the lock.
  void Advance() {
    if (read_wanted_ && state_ == State::kOpen && bytes_ <= kMaxWaiting * max_bytes_) {
      read_wanted_ = false;
      wire_->Read();
    }
    if (writing_ || state_ == State::kFinished) return;
    if (!queue_.empty()) {
      writing_ = true;
      written_at_ = time_.Now();
      wire_->Write(&queue_.front().message);
    } else if (state_ == State::kClosing && holds_ == 0) {
      state_ = State::kFinished;
      wire_->Finish(status_);
    }
  }

  // set_paused may make a dance deliver frames and re-enter here. The outermost call then
  // continues.
  void UpdatePressure() {
    strand_.Run(
        mutex_, std::numeric_limits<int>::max(),
        [this]() -> std::optional<bool> {
          const bool want = paused_ ? bytes_ > max_bytes_ / 2 : bytes_ > max_bytes_;
          if (want == paused_) return std::nullopt;
          return paused_ = want;
        },
        [this](std::optional<bool> want) {
          if (want) set_paused_(*want);
        });
  }

  Wire* const wire_;
  const size_t max_bytes_;
  const std::function<void(bool)> set_paused_;
  const std::function<void(const Response&, Clock::time_point)> on_sent_;
  const TimeSource& time_;

  mutable std::mutex mutex_;  // guards the members below
  State state_ = State::kOpen;
  std::deque<Item> queue_;  // the front is being written if writing_
  size_t bytes_ = 0;        // the queue's size
  bool writing_ = false;
  Clock::time_point written_at_ = time_.Now();  // the last answer, or when its writing began
  Clock::time_point read_at_ = time_.Now();     // when the last message was handled
  bool read_wanted_ = false;
  int holds_ = 0;
  bool paused_ = false;
  Strand strand_;  // of calls to set_paused_
  grpc::Status status_;
};

}  // namespace choreo
