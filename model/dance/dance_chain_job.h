#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "model/dance/ask_transition.h"
#include "model/dance/dance_chain.h"
#include "model/dance/scheduled_transition.h"
#include "model/dance/warning.h"

namespace choreo {

/// One transition of the chain. Its run changes with the chain's mutex held.
class DanceChain::Job : public ScheduledTransition {
 public:
  Job(std::shared_ptr<DanceChain> chain, const Segment& segment, AskedTransition asked)
      : ScheduledTransition(chain->model_, std::move(asked.request), chain->audio()),
        chain_(std::move(chain)),
        segment_(segment),
        start_time_(chain_->start_time_),
        warnings_(std::move(asked.warnings)) {}

  bool NextInput(StepInput* input) override {
    std::lock_guard lock(chain_->mutex_);
    if (!HasInput()) return false;
    FillInput(input);
    return true;
  }

  bool Ready() const override {
    std::lock_guard lock(chain_->mutex_);
    return HasInput();
  }

  void OnRestart() override {
    std::lock_guard lock(chain_->mutex_);
    ScheduledTransition::OnRestart();
  }

  bool OnFrame(const StepOutput& raw) override {
    bool more = false;
    {
      std::lock_guard lock(chain_->mutex_);
      const std::optional<DanceFrame> frame = TakeNew(raw);
      if (!frame) return true;
      chain_->Emit(segment_, run(), *frame, warnings_);
      more = !chain_->CurrentIsDanced();
    }
    chain_->mailbox_.Deliver();
    return more;
  }

  void OnDone(const Error* failure) noexcept override {
    chain_->Act([this, failure] {
      chain_->job_ = nullptr;
      if (failure != nullptr && !retired_) return chain_->Fail(*failure);
      chain_->timeline_.Finish();
      if (danced() > 0) chain_->PostContinuation();
      chain_->Advance(/*inherits=*/true);
    });
  }

  double NextDeadline() const override {
    const int64_t frame = segment_.from + danced() - chain_->first_frame_;
    return start_time_ + chain_->Seconds(frame);
  }

  bool Cancelled() const override { return retired_ || chain_->cancelled_; }

  /// The dance, or the transition, turned out to end before the next frame: it ends in good order.
  void Retire() { retired_ = true; }

 private:
  // With the chain's mutex held.
  bool HasInput() const {
    if (chain_->paused_) return false;
    const int64_t frame = NextFrame();
    return frame < chain_->timeline_.Current()->stop && chain_->timeline_.Certain(frame) &&
           (!chain_->audio_ || chain_->audio_->ready() > frame);
  }

  const std::shared_ptr<DanceChain> chain_;
  const Segment segment_;
  const double start_time_;
  std::vector<DanceWarning> warnings_;  // of its controls; told with the first frame
  std::atomic<bool> retired_ = false;
};

}  // namespace choreo
