#include "studio/song.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "client/authoring/keys/proposed_keys.h"
#include "client/authoring/notes/notes.h"
#include "model/core/rounded.h"

namespace choreo::studio {
namespace {

constexpr double kSuggestedEvery = 2.4;  // seconds, approximately
constexpr double kPeaksPerSecond = 40;
constexpr int64_t kMaxPeaks = 12000;

/// Peak amplitudes of equal pieces.
std::vector<float> Peaks(const DecodedAudio& audio) {
  const int64_t samples = audio.samples();
  const int64_t count = std::clamp<int64_t>(std::llround(audio.seconds() * kPeaksPerSecond), 1,
                                            std::min(kMaxPeaks, samples));
  std::vector<float> peaks(static_cast<size_t>(count));
  for (int64_t i = 0; i < count; ++i) {
    const float* first =
        &audio.interleaved[static_cast<size_t>(i * samples / count * audio.channels)];
    const float* end = audio.interleaved.data() + (i + 1) * samples / count * audio.channels;
    for (; first < end; ++first)
      peaks[static_cast<size_t>(i)] = std::max(peaks[static_cast<size_t>(i)], std::abs(*first));
  }
  return peaks;
}

}  // namespace

Song HearSong(const std::filesystem::path& path, const std::string& name, double most_seconds) {
  Song song;
  // Notes about a copy of the song would name that. The page shows them.
  std::optional<authoring::NotesApart> unseen;
  if (path != name) unseen.emplace();
  try {
    // Stops decoding songs that are too long.
    song.music = authoring::ReadMusic(path, most_seconds);
  } catch (const Error& error) {
    throw error.Of(name);
  }
  const double seconds = song.music.audio.seconds();
  if (seconds > most_seconds)
    throw InvalidArgument(name,
                          "is longer than " + Rounded(most_seconds) + " s, the longest allowed");
  song.audio = authoring::AudioFor(song.music.audio, seconds);
  const std::vector<double> beats = song.music.track.Seconds();
  song.heard.set_seconds(seconds);
  song.heard.set_tempo(song.music.track.tempo_bpm);
  song.heard.mutable_beats()->Add(beats.begin(), beats.end());
  song.heard.set_beats_in_bar(static_cast<uint32_t>(song.music.track.beats_in_bar));
  for (const int place : song.music.track.in_bar)
    song.heard.add_counts(static_cast<uint32_t>(place + 1));
  const std::vector<double>& confidence = song.music.track.confidence;
  song.heard.mutable_confidence()->Add(confidence.begin(), confidence.end());
  for (const Passage& passage : song.music.passages) {
    v1::MusicPassage* added = song.heard.add_passages();
    added->set_from(passage.from);
    added->set_to(passage.to);
    added->set_like(passage.like);
  }
  const int64_t count =
      std::min(MostKeys(beats), static_cast<int64_t>(std::ceil(seconds / kSuggestedEvery)));
  if (count > 0) {
    for (const authoring::ProposedKey& key : authoring::ProposeKeys(song.music, {count})) {
      SuggestedKey* added = song.heard.add_suggested();
      added->set_time(key.on.time_s);
      added->set_pose(key.pose);
    }
  }
  for (const std::string& note : song.music.audio.notes) song.heard.add_notes(note);
  const std::vector<float> peaks = Peaks(song.music.audio);
  song.heard.mutable_peaks()->Add(peaks.begin(), peaks.end());
  return song;
}

}  // namespace choreo::studio
