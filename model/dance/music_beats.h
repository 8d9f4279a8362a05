#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats_ahead.h"
#include "model/audio/format.h"
#include "model/audio/music_analysis.h"
#include "model/dance/audio_feed.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Rows of music, before a transition, that its beats can depend on.
inline constexpr int kBeatMemory = 13 * static_cast<int>(kModelFps);

/// The beats heard in a dance's music, remembered for transitions that begin in the same second.
/// Thread-safe.
class HeardMusic {
 public:
  /// The music must outlive it.
  explicit HeardMusic(const AudioFeed& audio) : audio_(&audio) {}

  /// Those in the rows before `row`, which must be ready: a function of their samples.
  HeardBeats Before(int64_t row);

 private:
  const AudioFeed* audio_;
  std::mutex mutex_;    // guards the members below
  int64_t until_ = -1;  // the row before which heard_ ends
  HeardBeats heard_;
};

/// What is known of the beats when a transition is planned. A value: later messages change nothing.
class PlannedBeats {
 public:
  // Seconds in which only given beats count. Spans ascend and do not overlap.
  struct Span {
    double begin, end;
  };

  /// `heard`: null to predict none.
  PlannedBeats(double fps, std::vector<Beat> known, std::vector<Span> spans,
               std::shared_ptr<HeardMusic> heard);

  /// The beats for a transition of the frames [from, to), ascending: those known, and around them
  /// those predicted from the music before `from`, whose rows must be ready.
  std::vector<Beat> For(int64_t from, int64_t to) const;

 private:
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }
  void Predict(int64_t from, int64_t to, std::vector<Beat>* beats) const;

  double fps_;
  std::vector<Beat> known_;
  std::vector<Span> spans_;
  std::shared_ptr<HeardMusic> heard_;
};

/// The beats of a dance's music. They are given by the client or found in the whole music. A dance
/// that starts without any detects them: when a transition begins, the beats of the 12 s before the
/// last whole second (HearBeats) predict its own. So beats are a function of the
/// ordered messages and the samples before the transition. Not thread-safe.
class MusicBeats {
 public:
  /// `audio`: the dance's, or null to detect no beats.
  MusicBeats(double fps, const std::vector<double>& given, const AudioFeed* audio,
             std::span<const double> downbeats = {});

  /// Replaces all beats by those found in the whole music, and stops detection.
  void ReplaceAll(const MusicAnalysis& music);

  /// Gives beats, ascending, for transitions that begin at `from` or later. From the first to the
  /// last they replace beats given or detected. Beats given earlier are dropped if they are after
  /// the last, or less than half a beat before the first. Beats before `from` are late and are
  /// dropped; returns how many. `from` never decreases between calls. `downbeats`: those of the
  /// beats that begin a bar. `confidence`: of a client that predicts them from this music, else
  /// none. Throws Error(kInvalidArgument) beyond kMaxBeats.
  int64_t AddGiven(std::span<const double> seconds, int64_t from, const std::string& field,
                   std::span<const double> downbeats = {}, std::optional<double> confidence = {});

  /// What is known for a transition that begins at `from`; call in order of time.
  PlannedBeats PlanFrom(int64_t from);

 private:
  // The beats of one AddGiven.
  struct Given {
    int64_t from;
    double begin;                 // its first beat, late or not
    std::vector<double> seconds;  // without late ones
    std::vector<double> downbeats;
    std::optional<double> confidence;  // of predicted ones
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }
  void Replace(double begin, std::span<const double> seconds, std::span<const double> downbeats,
               const Beat& like);

  double fps_;
  const AudioFeed* audio_;
  std::shared_ptr<HeardMusic> heard_;  // null: detects none
  std::vector<Beat> known_;            // given or found, for this transition and later ones
  std::vector<PlannedBeats::Span> spans_;
  std::deque<Given> given_;  // not yet in known_
  size_t count_ = 0;         // given in all
};

/// Which beat to report with which frame of a dance. Not thread-safe.
class BeatReport {
 public:
  /// `audio`: the dance's, or null. `last`: for a resumed dance, last() at its first frame.
  BeatReport(double fps, const AudioFeed* audio, std::optional<double> last)
      : fps_(fps), audio_(audio), last_(last) {}

  /// Starts handing out the transition that begins at `from` and has these beats.
  void Start(std::span<const Beat> beats, int64_t from);

  /// The beats to report with a frame of that transition. Call once per frame, in order; its row
  /// must be ready. Every beat is reported once, even if two transitions place it on different
  /// sides of their boundary; a beat that each leaves to the other comes with the first frame after
  /// it. Drops beats that were predicted before the music fell silent, from one period after its
  /// last sound on.
  std::vector<Beat> TakeAt(int64_t frame);

  /// The last beat reported, in seconds: all the state that resuming a dance here needs.
  const std::optional<double>& last() const { return last_; }

  /// All beats reported, seconds, ascending.
  const std::vector<double>& reported() const { return reported_; }

 private:
  // A beat to report, and its distance to the nearer neighbour; 0 without neighbours.
  struct Ahead {
    Beat beat;
    double step;
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }

  double fps_;
  const AudioFeed* audio_;
  std::deque<Ahead> ahead_;  // of the transition, not yet reported
  std::optional<double> last_;
  std::vector<double> reported_;
};

/// Beats -> their seconds.
std::vector<double> SecondsOf(std::span<const Beat> beats);

}  // namespace choreo
