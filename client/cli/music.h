#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include "client/choreo_client.h"
#include "client/cli/music_beats.h"
#include "client/cli/music_file.h"
#include "model/audio/beats.h"
#include "model/audio/decode.h"
#include "model/core/passage.h"

namespace choreo::cli {

/// A song as the commands need it.
struct Music {
  DecodedAudio audio;
  std::vector<float> mono;            ///< at 22 050 Hz
  std::vector<float> onset_strength;  ///< in which the beats were found
  BeatTrack track;
  std::vector<Passage> passages;  ///< that come back
  uint64_t id = 0;                ///< MusicId
};

/// Decodes a song and finds its beats: all of it, or its first `seconds` and what comes after them
/// as far as they depend on it. With `start`, as if the song began at that second of it. Errors as
/// DecodeSong and BeatsAsAsked; Error(kInvalidArgument) whose field is --song-start for one behind
/// its end. Writes notes to standard error.
Music ReadMusic(const std::filesystem::path& path,
                double seconds = std::numeric_limits<double>::infinity(), double start = 0,
                const BeatOptions& beats = {});

/// Times of the beats before `seconds`, as DanceConfig::music_beats.
std::vector<double> BeatsBefore(const Music& music, double seconds);

/// Those, with their downbeats, the passages before `seconds`, and which music it is. Beats that
/// the configuration has already stay, as far as they are before `seconds`.
void TellMusic(const Music& music, double seconds, client::DanceConfig* config);

/// What to send for a dance of `seconds`: the song's beginning, as samples.
client::Audio AudioFor(const DecodedAudio& song, double seconds);

/// Of samples.
double Seconds(const client::Audio& audio);

}  // namespace choreo::cli
