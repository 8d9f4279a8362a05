#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <utility>

#include "model/engine/sample_queue.h"

namespace choreo {

/// The most frames handed out before other dances get a turn or gRPC gets its thread back.
inline constexpr int kFramesASlice = 16;

/// Lets a worker call `Owner::HandOut` until nothing is left. At most one job waits at a time.
/// Thread-safe.
template <class Owner>
class HandOver {
 public:
  /// Calls `submit` with a job that hands out, unless one is already waiting. If the queue refuses
  /// the job, or there is no memory for it, this thread hands out the rest.
  void ToWorker(std::shared_ptr<Owner> owner, double deadline, const auto& submit) {
    if (is_requested_.exchange(true)) return;
    Owner& here = *owner;
    try {
      submit(std::make_shared<Job>(std::move(owner), deadline));
    } catch (const std::exception&) {
      is_requested_ = false;
      while (here.HandOut()) {
      }
    }
  }

 private:
  class Job : public SampleJob {
   public:
    Job(std::shared_ptr<Owner> owner, double deadline)
        : owner_(std::move(owner)), deadline_(deadline) {}

    bool Continue(Sampler& /*sampler*/) override {
      std::atomic<bool>& is_requested = owner_->hand_over().is_requested_;
      is_requested = false;  // from here on, other threads may request another job
      return owner_->HandOut() && !is_requested.exchange(true);
    }
    void OnDone(const Error* failure) noexcept override {
      if (failure == nullptr) return;
      owner_->hand_over().is_requested_ = false;
      owner_->OnFailure(*failure);
    }
    double Deadline() const override { return deadline_; }
    int frames() const override { return 0; }
    bool Cancelled() const override { return owner_->Cancelled(); }

   private:
    const std::shared_ptr<Owner> owner_;
    const double deadline_;
  };

  std::atomic<bool> is_requested_ = false;
};

}  // namespace choreo
