#pragma once

#include <filesystem>
#include <vector>

#include "client/choreo_client.h"
#include "model/audio/decode.h"

namespace choreo::cli {

/// A song as the commands need it.
struct Music {
  DecodedAudio audio;
  std::vector<float> mono;  ///< at 22 050 Hz
  double tempo_bpm = 0;
  std::vector<double> beats;  ///< seconds
};

/// Decodes a song and finds its beats. Errors as DecodeAudioFile.
Music ReadMusic(const std::filesystem::path& path);

/// What to send for a dance of `seconds`: its beginning, as samples.
client::Audio AudioFor(const Music& music, double seconds);

}  // namespace choreo::cli
