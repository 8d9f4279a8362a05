#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/dance_sink.h"
#include "model/dance/mailbox.h"
#include "model/dance/music_beats.h"
#include "model/dance/output_rate.h"
#include "model/dance/quality_report.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// The chain of transitions behind a DanceStream: has what the timeline plans sampled one
/// transition after the other, each as soon as it is known where it begins, and hands frames out as
/// they are granted, as their music comes and as the sink takes them. Thread-safe. Lock order: the
/// chain's before the queue's and the audio feed's; the sink is called under none. Kept alive by
/// its jobs.
class DanceChain : public std::enable_shared_from_this<DanceChain> {
 public:
  /// The config must be valid.
  DanceChain(SampleQueue& queue, const ValidDance& asked, std::shared_ptr<DanceSink> sink);

  /// What there is to say before the first message.
  void Begin();

  /// Applies a change (of the keys, or of what is known of the music) and goes on from there. What
  /// the change throws passes through and leaves the chain as it was. Without effect once the dance
  /// is over.
  void Change(const std::function<void(Timeline&)>& change);

  /// The request is valid.
  void SetControls(const ControlRequest& request, const std::string& field);
  /// Ascending; at least one.
  void GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats,
                 const std::string& field);

  /// Tells the sink of an event; only inside a change.
  void Post(const DanceEvent& event);

  /// The last call to the sink is made or under way.
  bool over() const { return mailbox_.over(); }

  /// Null for a dance without music. Only one thread at a time may push.
  AudioFeed* audio() { return audio_.get(); }

  /// Ascending; at least one.
  void GivePassages(const std::vector<Passage>& passages, const std::string& field);

  /// Of the whole music, before its first sample.
  void SetMusic(const std::vector<double>& beats, const std::vector<double>& downbeats,
                const std::vector<Passage>& passages, uint64_t music_id);
  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  // Called without mutex_: acts with it held, then goes on with the dance.
  void Act(const std::function<void()>& act) noexcept;
  // Hands out what may go out, and tells the sink: `most` frames and ends of transitions at most.
  // One thread at a time does; what others come for it hands out, too. True where there may be
  // more.
  bool HandOut(int most);

  double Seconds(int64_t frames) const { return static_cast<double>(frames) / model_.fps; }

  // Those below are called with mutex_ held.
  // A frame, or the end of a transition or of the dance; false where nothing may go out now.
  bool HandOutNext();
  void AskNext();
  void Ask(const Segment& segment, int64_t rows_end);
  bool IsOver(const Segment& segment) const;
  void Fail(Job& job, const Error& failure);
  void DropJobs();
  void PostContinuation();
  void Summarise();
  void Emit(const Job& job, const DanceFrame& frame);

  SampleQueue& queue_;
  const ModelInfo& model_;
  DanceConfig config_;  // but for music_id constant
  const int64_t first_frame_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;
  Mailbox<DanceSink> mailbox_;
  const std::unique_ptr<AudioFeed> audio_;

  mutable std::mutex mutex_;  // of what follows
  double start_time_;         // of the playback: frames are due by it
  Timeline timeline_;
  ControlTrack controls_;
  // Of the timeline's transitions the first ones: the one that is handed out, and one ahead of it.
  // All but the last are sampled.
  std::deque<std::shared_ptr<Job>> jobs_;
  std::optional<Error> failure_;  // for which no transition can be asked for behind them
  // The last tau poses handed out; empty until the first frame of a dance that is given none.
  std::vector<Pose> history_;
  std::optional<Eigen::Vector3d> stage_;  // where the dance keeps to, from the first transition on
  int64_t next_frame_;                    // to be handed out
  bool handing_out_ = false, look_again_ = false;
  QualityMeter meter_;
  OutputRate output_;
  MusicBeats beats_;
  Recurrence recurrence_;
};

}  // namespace choreo
