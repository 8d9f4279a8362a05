#pragma once

#include <cstdint>
#include <vector>

#include "client/choreo_client.h"

/// Dances like a player: sends a song in real time, in chunks as from a sound card, and measures
/// when each frame arrives.
///
/// A frame is due when the chunk has been sent that holds the sample it needs: that of its own time
/// plus the header's `latency_frames`. Its lateness is the time from then to its arrival. It is
/// missed if a player that follows the music at a distance of latency_frames, one chunk and 50 ms
/// lacks it.
namespace choreo::bench {

struct LiveRequest {
  double shortest_chunk_s = 0.1, longest_chunk_s = 0.1;  ///< lengths are uniformly distributed
  double key_each_s = 2;
  uint32_t seed = 0;
};

struct Lateness {
  std::vector<double> first_ms;  ///< of first frames
  std::vector<double> all_ms;    ///< of all frames
  int missed = 0;
  std::vector<double> refused_ms;  ///< of refused dances: time until the refusal

  void Add(const Lateness& other);
};

/// The quantile of the values at `share`; NaN for none. Reorders them.
double Percentile(std::vector<double>& values, double share);

/// A click song with two beats a second.
client::Audio ClickSong(double seconds, int sample_rate, int channels);

/// Key poses of the library every `key_each_s`, the last one 0.1 s before the song's end.
void SendKeys(client::RemoteDance& dance, double seconds, double key_each_s);

/// One dance to all of `song` (kPcmFloat). Blocks until its last frame came, or until the song's
/// end if the server was full.
Lateness DanceLive(const client::Client& client, const client::Audio& song,
                   const LiveRequest& request);

}  // namespace choreo::bench
