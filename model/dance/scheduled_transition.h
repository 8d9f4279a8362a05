#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/transition.h"
#include "model/engine/scheduler.h"

namespace choreo {

/// The clock of StepJob::NextDeadline, seconds. It decides who goes first, never what is danced.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A transition on its way through the scheduler, be it a stream's or one of a group's candidates:
/// makes its inputs, takes its frames, and after a restart tells none twice. Model and feed must
/// outlive it. As thread-safe as TransitionRun; `danced` is.
class ScheduledTransition : public StepJob {
 public:
  const TransitionSpec& spec() const override { return run_->spec(); }
  void OnRestart() override { run_.emplace(model_, request_); }

  const TransitionRun& run() const { return *run_; }

 protected:
  /// `audio`: null without music.
  ScheduledTransition(const ModelInfo& model, TransitionRequest request, const AudioFeed* audio)
      : model_(model),
        request_(std::move(request)),
        audio_(audio),
        run_(std::in_place, model_, request_),
        row_(static_cast<size_t>(model_.audio_features)) {}

  /// The frame that NextInput asks for, absolute.
  int64_t NextFrame() const { return request_.first_frame + run_->done(); }
  /// That frame's input; its audio row must be ready.
  void FillInput(StepInput* input) {
    if (audio_ != nullptr) {
      audio_->CopyRow(NextFrame(), row_);
      input->audio_row = row_;
    }
    input->previous = run_->previous();
  }
  /// The dance's frame; none if it was told before a restart.
  std::optional<DanceFrame> TakeNew(const StepOutput& raw) {
    DanceFrame frame = run_->Take(raw);
    if (run_->done() <= danced_) return std::nullopt;
    danced_ = run_->done();
    return frame;
  }
  /// Frames that were told.
  int danced() const { return danced_; }

 private:
  const ModelInfo& model_;
  const TransitionRequest request_;
  const AudioFeed* const audio_;
  std::optional<TransitionRun> run_;
  std::vector<float> row_;
  std::atomic<int> danced_ = 0;
};

}  // namespace choreo
