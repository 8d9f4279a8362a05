#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/format.h"
#include "model/dance/audio_feed.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Where the music of a dance beats. Beats are given or found. A dance that starts without any
/// listens: when a transition begins, the pulse (HearPulse) of the 12 s before its first frame
/// predicts its beats. So they are a function of the ordered messages and of the samples before
/// the transition; earlier transitions leave only last(). Not thread-safe.
class MusicBeats {
 public:
  /// `audio`: of the dance, or null, when there is nothing to hear. `last`: of a dance that goes
  /// on, last() at its first frame.
  MusicBeats(double fps, const std::vector<double>& given, std::optional<double> last,
             const AudioFeed* audio, std::span<const double> downbeats = {});

  /// In the whole music; in place of all, and nothing is heard any more. Here as elsewhere
  /// downbeats are some of the beats.
  void Find(const std::vector<double>& seconds, std::span<const double> downbeats = {});

  /// Ascending. From the first of them to the last they hold in place of what was given or heard,
  /// and none given before lies behind them or less than half a beat before the first, for
  /// transitions that begin at `from` or later; `from` never shrinks from call to call. Those
  /// before `from` are late, and left out; returns how many. Throws Error(kInvalidArgument) beyond
  /// kMostBeats.
  int64_t Give(std::span<const double> seconds, int64_t from, const std::string& field,
               std::span<const double> downbeats = {});

  /// All that is known for a transition of the frames [from, to), ascending; transitions are asked
  /// for in order of time, each once. Rows before `from` must be ready.
  std::vector<Beat> For(int64_t from, int64_t to);
  /// Of those the ones that the transition is timed to, as TransitionRequest::beats.
  std::vector<double> Around(std::span<const Beat> beats, int64_t from, int64_t to) const;

  /// The frames of the transition that has these beats come next, from `from` on.
  void Begin(std::span<const Beat> beats, int64_t from);

  /// What is told with a frame of that transition whose row is ready; each frame is asked for once,
  /// in order. Every beat is told once, also where two transitions put it on either side of their
  /// boundary; one that each leaves to the other comes with the first frame behind it.
  std::vector<Beat> Of(int64_t frame);

  /// The last one told, in seconds: all that a dance which is to go on from here has to know.
  const std::optional<double>& last() const { return last_; }

  /// All that were told, seconds, ascending.
  const std::vector<double>& told() const { return told_; }

 private:
  // What one Give said.
  struct Given {
    int64_t from;
    double begin;                 // its first beat, late or not
    std::vector<double> seconds;  // those that are not late
    std::vector<double> downbeats;
  };
  // Seconds in which only given beats count; one begins where the one before has ended, or later.
  struct Span {
    double begin, end;
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }
  void Replace(double begin, std::span<const double> seconds, std::span<const double> downbeats,
               Beat::Source source);
  void Predict(int64_t from, int64_t to, std::vector<Beat>* beats) const;

  double fps_;
  const AudioFeed* audio_;
  bool hears_;
  std::vector<Beat> known_;  // given or found, for the transition and those behind it
  std::vector<Span> spans_;
  std::deque<Given> given_;  // not yet in known_
  size_t count_ = 0;         // of all that was given
  std::deque<Beat> ahead_;   // of the transition, still to be told
  std::optional<double> last_;
  std::vector<double> told_;
};

}  // namespace choreo
