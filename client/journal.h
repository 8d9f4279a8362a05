#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"

namespace choreo::client {

/// What has been said in a dance, in order, for another server to hear it again: a dance is resumed
/// by the last continuation and the same messages. Only music that it no longer needs is forgotten.
/// Not thread-safe.
class Journal {
 public:
  using Request = std::shared_ptr<const v1::StreamDanceRequest>;

  /// `bytes_per_sample`: of all channels together; 0 for a music file, which is decoded as a whole.
  /// `first_sample`: where the music starts.
  Journal(int bytes_per_sample, int64_t first_sample)
      : bytes_per_sample_(bytes_per_sample), end_sample_(first_sample) {}

  void Append(v1::StreamDanceRequest request);
  /// Music follows; of a file, samples are bytes.
  void AppendMusic(std::string bytes);
  /// The next request that the present server has not been sent, or null.
  Request TakeNext();
  /// There is another server, to which everything must be said again.
  void Rewind() { next_ = 0; }
  /// Another server would need the music from this sample on alone.
  void ForgetMusicBefore(int64_t sample);
  /// Where the music starts that is still here.
  int64_t first_sample() const;
  /// What was said of keys that stood before `frame` then: their ids and frames, in order. Models
  /// run at `fps`.
  std::vector<std::pair<std::string, int64_t>> KeysBefore(int64_t frame, double fps) const;

 private:
  int bytes_per_sample_;
  int64_t end_sample_;
  std::vector<Request> requests_;
  size_t next_ = 0;
};

}  // namespace choreo::client
