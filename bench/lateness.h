#pragma once

#include <cstdint>
#include <vector>

#include "client/choreo_client.h"

/// Dances like a live player: sends a song in real time, in chunks as from a sound card, and
/// measures the arrival of each frame.
///
/// A frame is due once the chunk with the last sample that it needs has been sent: the sample at
/// its own time plus the header's `latency_frames`. Its lateness is the time from then to its
/// arrival. It is missed if it arrives too late for a player that follows the music by
/// latency_frames, one chunk and 50 ms.
namespace choreo::bench {

struct LiveRequest {
  double shortest_chunk_s = 0.1, longest_chunk_s = 0.1;  ///< uniformly distributed
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

/// The quantile of the values at `share`; NaN for no values. Reorders the values.
double Percentile(std::vector<double>& values, double share);

/// A song of clicks, two beats a second.
client::Audio ClickSong(double seconds, int sample_rate, int channels);

/// Key poses of the library every `key_each_s`, the last one 0.1 s before the song's end.
void SendKeys(client::RemoteDance& dance, double seconds, double key_each_s);

/// Makes one dance to all of `song` (kPcmFloat). Blocks until the last frame has arrived, or until
/// the song's end if the server was full.
Lateness DanceLive(const client::Client& client, const client::Audio& song,
                   const LiveRequest& request);

}  // namespace choreo::bench
