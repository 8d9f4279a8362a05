#pragma once

#include <cstdint>
#include <vector>

#include "client/choreo_client.h"

/// Dances as a player would have them: a song is sent in real time, in chunks as a sound card hands
/// them over, and the arrival of every frame is measured.
///
/// A frame is due when the chunk has been sent that holds the sample it needs: that of its own time
/// plus the header's `latency_frames`. Its lateness is how much later it came. A frame is missed if
/// a player lacks it that follows the music at the distance of latency_frames, one chunk and 50 ms.
namespace choreo::bench {

struct LiveRequest {
  double shortest_chunk_s = 0.1, longest_chunk_s = 0.1;  ///< lengths are drawn evenly
  double key_each_s = 2;
  uint32_t seed = 0;
};

struct Lateness {
  std::vector<double> first_ms;  ///< of first frames
  std::vector<double> all_ms;    ///< of all frames
  int missed = 0;
  std::vector<double> refused_ms;  ///< of dances that were refused: until they were told

  void Add(const Lateness& other);
};

/// The value that a share of the values does not exceed; NaN of none. Reorders them.
double Percentile(std::vector<double>& values, double share);

/// A made-up song with two beats a second.
client::Audio ClickSong(double seconds, int sample_rate, int channels);

/// Key poses of the library each `key_each_s`, the last one 0.1 s before the song's end.
void SendKeys(client::RemoteDance& dance, double seconds, double key_each_s);

/// One dance to all of `song` (kPcmFloat). Blocks until its last frame came, or the song is over
/// where the server was full.
Lateness DanceLive(const client::Client& client, const client::Audio& song,
                   const LiveRequest& request);

}  // namespace choreo::bench
