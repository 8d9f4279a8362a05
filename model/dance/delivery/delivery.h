#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "model/core/error.h"
#include "model/dance/delivery/hand_over.h"
#include "model/dance/delivery/mailbox.h"
#include "model/dance/delivery/strand.h"
#include "model/dance/transition/transition.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// The base of a stream's chain and of a group of candidates. Jobs sample transitions. One thread
/// at a time hands out their results to the sink, in the order of TakeNext and without the lock.
/// Thread-safe. Lock order: this object's lock, then the queue's and the audio feed's. The jobs
/// keep this object alive.
template <class Sink>
class Delivery : public std::enable_shared_from_this<Delivery<Sink>> {
 public:
  /// Applies back-pressure: hands out nothing while paused, except what is in progress.
  void SetPaused(bool paused) {
    paused_ = paused;
    if (!paused) React([] {});
  }
  /// Cancels the jobs. The sink gets OnError(kCancelled) unless it has had its last call.
  void Cancel() noexcept {
    cancelled_ = true;
    queue_.CheckCancelled();
    React([this] { mailbox_.PostError(Error(ErrorCode::kCancelled, "", "cancelled")); });
  }

  /// Whether a transition is queued or being sampled: the workers act next, not the client.
  bool IsSampling() const { return sampling_ > 0; }

  /// Hands out a few results. Returns true if there may be more.
  bool HandOut() {
    return strand_.Run(
        mutex_, kFramesASlice, [this] { return Take(); },
        [this](std::function<void()> report) {
          if (report) std::exchange(report, {})();  // and frees its captures
          mailbox_.Deliver();                       // the sink may pause this
        });
  }

  // For HandOver.
  HandOver<Delivery>& hand_over() { return hand_over_; }
  bool Cancelled() const { return cancelled_; }
  /// Called when a job that hands out has failed.
  void OnFailure(const Error& failure) noexcept {
    React([&] {
      // After kUnavailable from a closing queue, what is already sampled is still handed out. Other
      // errors come from the sink.
      if (failure.code() != ErrorCode::kUnavailable) mailbox_.PostError(failure);
    });
  }

 protected:
  using Submit = void (SampleQueue::*)(std::shared_ptr<SampleJob>);

  /// One transition in the queue. A worker prepares, samples and finishes it, then hands out
  /// results.
  class Job : public SampleJob {
   public:
    Job(std::shared_ptr<Delivery> owner, int frames, double deadline)
        : owner_(std::move(owner)), frames_(frames), deadline_(deadline) {
      ++owner_->sampling_;
    }
    ~Job() override { Stop(); }

    bool Continue(Sampler& sampler) final {
      if (!slices_) slices_.emplace(Work(sampler));
      return slices_->Continue();
    }
    double Deadline() const final { return deadline_; }
    int frames() const final { return frames_; }
    bool Cancelled() const override { return owner_->cancelled_; }

    /// Constant once sampled.
    const TransitionRun& run() const { return *run_; }

   protected:
    /// Call when this job will sample no more.
    void Stop() {
      if (is_sampling_.exchange(false)) --owner_->sampling_;
    }

   private:
    virtual TransitionRun Prepare() = 0;
    /// Called once the transition is sampled.
    virtual Slices<> Finish() = 0;

    Slices<> Work(Sampler& sampler) {
      run_.emplace(Prepare());
      co_await Pause();
      co_await run_->Dance(sampler);
      Stop();
      co_await Finish();
      do {
        co_await Pause();
      } while (owner_->HandOut());
    }

    const std::shared_ptr<Delivery> owner_;
    const int frames_;
    const double deadline_;
    std::optional<TransitionRun> run_;  // once prepared
    std::optional<Slices<>> slices_;    // the worker's
    std::atomic<bool> is_sampling_ = true;
  };

  /// `submit`: how to submit the jobs that hand out. The queue must outlive the sink's last call
  /// and all jobs.
  Delivery(SampleQueue& queue, Submit submit, std::shared_ptr<Sink> sink)
      : queue_(queue), model_(queue.model()), mailbox_(std::move(sink)), submit_(submit) {}
  virtual ~Delivery() = default;

  /// Whether the last call to the sink has been made or is being made.
  bool over() const { return mailbox_.over(); }

  /// Runs `change` under the lock, then hands out what is due. Throws what `change` throws.
  void Change(const std::function<void()>& change) {
    {
      std::lock_guard lock(mutex_);
      change();
      Proceed();
    }
    HandOutHere();
  }
  /// Like Change, but ends the dance if `change` throws: there is no caller to throw to.
  void React(const std::function<void()>& change) noexcept {
    try {
      Change(change);
    } catch (...) {
      mailbox_.GiveUp();
      std::lock_guard lock(mutex_);
      Drop();
    }
  }

  SampleQueue& queue_;
  const ModelInfo& model_;
  Mailbox<Sink> mailbox_;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;  // guards what TakeNext uses

 private:
  // The next four functions require mutex_. TakeNext returns a function that reports the next
  // result without the lock, or null if nothing may be handed out.
  virtual std::function<void()> TakeNext() = 0;
  // Submits the jobs that a change makes possible.
  virtual void Proceed() {}
  // Frees all results. Called after the sink's last call.
  virtual void Drop() = 0;
  // The time at which the next result is due, by PlaybackClock.
  virtual double Due() const = 0;

  std::function<void()> Take() {
    if (over()) {
      Drop();
      return {};
    }
    return paused_ ? nullptr : TakeNext();
  }

  // Hands out a few results on this thread, which may be gRPC's; a worker hands out the rest.
  void HandOutHere() {
    if (!HandOut()) return;
    double due = 0;
    {
      std::lock_guard lock(mutex_);
      due = Due();
    }
    hand_over_.ToWorker(this->shared_from_this(), due, [this](std::shared_ptr<SampleJob> job) {
      (queue_.*submit_)(std::move(job));
    });
  }

  const Submit submit_;
  std::atomic<int> sampling_ = 0;  // jobs queued or being sampled
  std::atomic<bool> paused_ = false;
  Strand strand_;  // of handing out
  HandOver<Delivery> hand_over_;
};

}  // namespace choreo
