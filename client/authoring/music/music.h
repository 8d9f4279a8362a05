#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/authoring/music/beat_options.h"
#include "client/authoring/music/decode_song.h"
#include "client/choreo_client.h"
#include "model/audio/beats/beats.h"
#include "model/audio/decode/decode.h"
#include "model/core/passage.h"

namespace choreo::authoring {

/// A decoded and analysed song.
struct Music {
  DecodedAudio audio;                 ///< from `start` on; possibly only the beginning is kept
  std::vector<float> mono;            ///< at 22 050 Hz
  std::vector<float> onset_strength;  ///< in which the beats were found
  BeatTrack track;
  std::vector<Passage> passages;  ///< repeats
  std::vector<float> energies;    ///< MusicAnalysis::energies
  uint64_t id = 0;                ///< MusicId
};

/// Decodes a song from second `start` on: all of it, or `seconds` and `more` (DecodeSong). Throws
/// as DecodeSong does, and Error(kInvalidArgument) whose field is "song_start" for a start after
/// the song's end. Notes go to the sink (notes.h), too.
DecodedAudio ReadSong(const std::filesystem::path& path, double seconds, double start,
                      double more = 0);

/// Decodes a song from second `start` on and finds its beats. Analyses as much of the song as the
/// limits allow, so that beats do not depend on the dance's length. Keeps the samples for a dance
/// of `seconds`. Throws as ReadSong and BeatsAsAsked do.
Music ReadMusic(const std::filesystem::path& path,
                double seconds = std::numeric_limits<double>::infinity(), double start = 0,
                const BeatOptions& beats = {});

/// Discards all data after the first `seconds`.
void KeepFirst(double seconds, Music* music);

/// The seconds of music that were heard, however many are kept.
double HeardSeconds(const Music& music);

/// The counts of the whole song.
Counts CountsOf(const Music& music);

/// Times of the beats before `seconds`, for KnownMusic::music_beats.
std::vector<double> BeatsBefore(const Music& music, double seconds);

/// Fills in what is known of the music, for a dance of `seconds`. Keeps given beats before
/// `seconds`.
void FillInMusic(const Music& music, double seconds, KnownMusic* known);

/// Returns the samples to send for a dance of `seconds`: the song's beginning.
client::Audio AudioFor(const DecodedAudio& song, double seconds);

/// The duration of the samples, seconds.
double Seconds(const client::Audio& audio);

}  // namespace choreo::authoring
