#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/format.h"
#include "model/dance/audio_feed.h"

namespace choreo {

/// Beats that one dance may be told: 20 a second of the longest music.
inline constexpr size_t kMostBeats = size_t{20} * kMaxAudioSeconds;

/// A beat of the music that a dance is timed to.
struct MusicBeat {
  enum class Source {
    kGiven,      ///< the client told
    kFound,      ///< in the whole music
    kPredicted,  ///< from the music before the transition's first frame
    kHeard,      ///< predicted, and an onset was there when its frame was danced
  };
  double seconds = 0;
  Source source = Source::kGiven;
  double confidence = 1;  ///< of the pulse that it was predicted by, 0 to 1; 1 otherwise
};

/// Where the music of a dance beats. Beats are given or found; a dance that is given none asks the
/// music for its pulse (HearPulse) at the begin of each transition: the 12 s before its first
/// frame, and nothing behind, say where its beats are. So beats are a function of the ordered
/// messages and of the samples, not of when these come. Not thread-safe.
class MusicBeats {
 public:
  /// `audio`: of the dance, or null, when there is nothing to hear. `last`: of a dance that goes
  /// on, the last beat before its first frame, as Last had it.
  MusicBeats(double fps, const std::vector<double>& given, std::optional<double> last,
             const AudioFeed* audio);

  /// In the whole music; in place of all, and nothing is heard any more.
  void Find(const std::vector<double>& seconds);

  /// From the first of them on in place of what was known, for transitions that begin at `from` or
  /// later; `from` never shrinks from call to call. Behind the last of them beats are heard again.
  /// Throws Error(kInvalidArgument) beyond kMostBeats.
  void Give(std::vector<double> seconds, int64_t from, const std::string& field);
  /// The transition that was told of beats at `frame` and behind it stops there.
  void Cut(int64_t frame);

  /// Those of the transition of the frames [from, to), as TransitionRequest::beats. In order of
  /// time, once each. Rows before `from` must be ready.
  std::vector<double> Around(int64_t from, int64_t to);

  /// Those of a frame whose row is ready, and whose transition began.
  std::vector<MusicBeat> Of(int64_t frame) const;

  /// The last one before `frame`, in seconds, which a dance that is to go on from there has to
  /// know; none where nothing is heard.
  std::optional<double> Last(int64_t frame) const;

  /// All so far, ascending.
  const std::vector<MusicBeat>& known() const { return known_; }

 private:
  struct Given {
    int64_t from;
    std::vector<double> seconds;
  };

  bool HearsFrom(int64_t frame) const;
  void Replace(const std::vector<double>& seconds, MusicBeat::Source source);
  std::vector<double> Predict(int64_t from, int64_t to);

  double fps_;
  const AudioFeed* audio_;
  bool hears_;
  std::vector<MusicBeat> known_;
  std::deque<Given> given_;  // not yet in known_
  size_t count_ = 0;         // of all that was given
};

}  // namespace choreo
