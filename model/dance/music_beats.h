#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats_ahead.h"
#include "model/audio/format.h"
#include "model/dance/audio_feed.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Rows of music, before a transition, that its beats can depend on.
inline constexpr int kBeatMemory = 13 * static_cast<int>(kModelFps);

/// The beats of a dance's music. They are given by the client or found in the whole music. A dance
/// that starts without any detects them: when a transition begins, the beats of the 12 s before the
/// last whole second (HearBeats) predict its own. So beats are a function of the
/// ordered messages and the samples before the transition; only last_reported() carries over from
/// earlier transitions. Not thread-safe.
class MusicBeats {
 public:
  /// `audio`: the dance's, or null to detect no beats. `last`: for a resumed dance, last_reported()
  /// at its first frame.
  MusicBeats(double fps, const std::vector<double>& given, std::optional<double> last,
             const AudioFeed* audio, std::span<const double> downbeats = {});

  /// Replaces all beats by those found in the whole music, and stops detection. Downbeats are
  /// always a subset of the beats.
  void ReplaceAll(const std::vector<double>& seconds, std::span<const double> downbeats = {});

  /// Gives beats, ascending, for transitions that begin at `from` or later. From the first to the
  /// last they replace beats given or detected. Beats given earlier are dropped if they are after
  /// the last, or less than half a beat before the first. Beats before `from` are late and are
  /// dropped; returns how many. `from` never decreases between calls. Throws
  /// Error(kInvalidArgument) beyond kMaxBeats.
  int64_t AddGiven(std::span<const double> seconds, int64_t from, const std::string& field,
                   std::span<const double> downbeats = {});

  /// The known beats for a transition of the frames [from, to), ascending. Call once per
  /// transition, in order of time. Rows before `from` must be ready.
  std::vector<Beat> BeatsFor(int64_t from, int64_t to);
  /// The subset to which the transition is timed, for TransitionSpec::beats.
  std::vector<double> BeatTimes(std::span<const Beat> beats, int64_t from, int64_t to) const;

  /// Starts handing out the transition that begins at `from` and has these beats.
  void StartReporting(std::span<const Beat> beats, int64_t from);

  /// The beats to report with a frame of that transition. Call once per frame, in order; its row
  /// must be ready. Every beat is reported once, even if two transitions place it on different
  /// sides of their boundary; a beat that each leaves to the other comes with the first frame after
  /// it.
  std::vector<Beat> TakeBeatsAt(int64_t frame);

  /// The last beat reported, in seconds: all the state that resuming a dance here needs.
  const std::optional<double>& last_reported() const { return last_; }

  /// All beats reported, seconds, ascending.
  const std::vector<double>& reported() const { return reported_; }

 private:
  // The beats of one AddGiven.
  struct Given {
    int64_t from;
    double begin;                 // its first beat, late or not
    std::vector<double> seconds;  // without late ones
    std::vector<double> downbeats;
  };
  // Seconds in which only given beats count. Spans ascend and do not overlap.
  struct Span {
    double begin, end;
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }
  void Replace(double begin, std::span<const double> seconds, std::span<const double> downbeats,
               Beat::Source source);
  void Predict(int64_t from, int64_t to, std::vector<Beat>* beats);

  double fps_;
  const AudioFeed* audio_;
  bool hears_;
  int64_t heard_until_ = -1;  // the row before which heard_ ends
  HeardBeats heard_;
  std::vector<Beat> known_;  // given or found, for this transition and later ones
  std::vector<Span> spans_;
  std::deque<Given> given_;  // not yet in known_
  size_t count_ = 0;         // given in all
  std::deque<Beat> ahead_;   // of the transition, not yet reported
  std::optional<double> last_;
  std::vector<double> reported_;
};

}  // namespace choreo
