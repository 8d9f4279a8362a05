#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "model/audio/format.h"
#include "model/dance/audio_feed.h"

namespace choreo {

/// Beats that one stream may be told: 20 a second of the longest music.
inline constexpr size_t kMostBeats = 20 * kMaxAudioSeconds;

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

/// Where the music of a dance beats. Beats are given or found; a dance that is to hear them, and is
/// given none, asks the music for its pulse (HearPulse) at the begin of each transition: the 12 s
/// before its first frame, and nothing behind, say where its beats are. So beats are a function of
/// the ordered messages and of the samples, not of when these come. Not thread-safe.
class MusicBeats {
 public:
  MusicBeats(double fps, const std::vector<double>& given, bool hear);

  /// In the whole music; in place of all.
  void Find(const std::vector<double>& seconds);
  /// From the first of them on in place of what was known, for the transitions that end behind
  /// `frozen`, which are those not planned yet.
  void Give(std::vector<double> seconds, int64_t frozen);

  /// Those of the transition of the frames [from, to), as TransitionRequest::beats. In order of
  /// time, once each. Without `audio` nothing is heard; rows before `from` must be ready.
  std::vector<double> Around(int64_t from, int64_t to, const AudioFeed* audio);

  /// Those in [from, to) seconds, all of whose frames are danced: their rows are ready.
  std::vector<MusicBeat> Between(double from, double to, const AudioFeed* audio) const;

  /// All so far, ascending.
  const std::vector<MusicBeat>& known() const { return known_; }

 private:
  struct Given {
    int64_t frozen = 0;
    std::vector<double> seconds;
  };

  void Replace(const std::vector<double>& seconds, MusicBeat::Source source);
  std::vector<double> Predict(int64_t from, int64_t to, const AudioFeed& audio);

  double fps_;
  bool hear_;
  std::vector<MusicBeat> known_;
  std::deque<Given> given_;  // not yet in known_
};

}  // namespace choreo
