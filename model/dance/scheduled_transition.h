#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/timeline.h"
#include "model/engine/scheduler.h"

namespace choreo {

/// The clock of StepJob::NextDeadline, seconds. It decides who goes first, never what is danced.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct AskedTransition {
  TransitionRequest request;
  std::string key_id;                  ///< what warnings call its target
  std::vector<DanceWarning> warnings;  ///< of its controls
};

/// What a dance that starts so asks of one of its transitions, but for its stage and its beats.
/// `before`: what was danced or given before it; empty: ControlTrack::Stance. `audio`: null without
/// music; its rows before the transition must be ready.
AskedTransition AskTransition(const DanceStart& start, const ModelInfo& model,
                              const ControlTrack& controls, const AudioFeed* audio,
                              const Segment& segment, std::span<const Pose> before);

/// A transition on its way through the scheduler, be it a stream's or one of a group's candidates:
/// makes its inputs, takes its frames, and after a restart tells none twice. Model and feed must
/// outlive it. As thread-safe as TransitionRun; `danced` is.
class ScheduledTransition : public StepJob {
 public:
  const TransitionSpec& spec() const override {
    if (!run_) run_.emplace(model_, request_);
    return run_->spec();
  }
  bool NextInput(StepInput* input) override {
    if (!Ready()) return false;
    if (audio_ != nullptr) {
      audio_->CopyRow(NextFrame(), row_);
      input->audio_row = row_;
    }
    input->previous = run_->previous();
    return true;
  }
  void OnRestart() override { run_.emplace(model_, request_); }
  double NextDeadline() const override { return start_time_ + danced_ / model_.fps; }

  const TransitionRun& run() const { return *run_; }
  /// Of its controls, and of its length, unless it begins late; to be told with the first frame.
  const std::vector<DanceWarning>& warnings() const { return warnings_; }

 protected:
  /// When there is a run: at once, or on the worker's thread when spec is first asked for. Those
  /// that begin late are many, and may be cancelled before; run and NextFrame are not asked for
  /// until then.
  enum class Begins { kAtOnce, kLate };
  /// `audio`: null without music. `start_time`: when its first frame is due. Ready must say whether
  /// the row of NextFrame is there. Throws as TransitionRun does, if it begins at once.
  ScheduledTransition(const ModelInfo& model, AskedTransition asked, const AudioFeed* audio,
                      double start_time, Begins begins = Begins::kAtOnce);

  /// The frame that NextInput asks for, absolute.
  int64_t NextFrame() const { return request_.first_frame + run_->done(); }
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
  std::vector<DanceWarning> warnings_;
  const AudioFeed* const audio_;
  const double start_time_;
  mutable std::optional<TransitionRun> run_;  // of the worker's thread where it begins late
  std::vector<float> row_;
  std::atomic<int> danced_ = 0;
};

}  // namespace choreo
