#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include "client/authoring/beat_options.h"
#include "client/authoring/counts.h"
#include "client/authoring/decode_song.h"
#include "client/choreo_client.h"
#include "model/audio/beats.h"
#include "model/audio/decode.h"
#include "model/core/passage.h"

namespace choreo::authoring {

/// A song for the commands.
struct Music {
  DecodedAudio audio;                 ///< from `start` on, of which only its beginning may be kept
  std::vector<float> mono;            ///< at 22 050 Hz
  std::vector<float> onset_strength;  ///< that the beats were found in
  BeatTrack track;
  std::vector<Passage> passages;  ///< repeats
  std::vector<float> energies;    ///< MusicAnalysis::energies
  uint64_t id = 0;                ///< MusicId
};

/// Decodes a song from second `start` on: all of it, or `seconds` and `more` (DecodeSong). Throws
/// what that throws; Error(kInvalidArgument) whose field is "song_start" for a start after its end.
/// Writes notes to standard error.
DecodedAudio ReadSong(const std::filesystem::path& path, double seconds, double start,
                      double more = 0);

/// Decodes a song and finds its beats. All of it is heard, as far as the limits allow, so that
/// beats are the same however much is danced to; samples are kept for a dance of `seconds`. With
/// `start` the song begins there. Throws what ReadSong and BeatsAsAsked throw.
Music ReadMusic(const std::filesystem::path& path,
                double seconds = std::numeric_limits<double>::infinity(), double start = 0,
                const BeatOptions& beats = {});

/// Keeps what is heard in the first `seconds`.
void KeepFirst(double seconds, Music* music);

/// The counts of the whole song.
Counts CountsOf(const Music& music);

/// Times of the beats before `seconds`, as DanceConfig::music_beats.
std::vector<double> BeatsBefore(const Music& music, double seconds);

/// Sets these beats with their downbeats, the passages before `seconds`, energies and the id. Keeps
/// beats that the configuration already has, as far as they are before `seconds`.
void ConfigureMusic(const Music& music, double seconds, client::DanceConfig* config);

/// The samples to send for a dance of `seconds`: the song's beginning.
client::Audio AudioFor(const DecodedAudio& song, double seconds);

/// The length of samples.
double Seconds(const client::Audio& audio);

}  // namespace choreo::authoring
