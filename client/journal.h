#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"

namespace choreo::client {

/// Stores all requests of a dance, in order, to repeat them to another server: a dance resumes from
/// the last continuation and the same messages. Discards only music that is no longer needed. Not
/// thread-safe.
class Journal {
 public:
  using Request = std::shared_ptr<const v1::StreamDanceRequest>;

  /// `bytes_per_sample`: of all channels together; 0 for a music file, which is decoded as a whole.
  /// `first_sample`: number of the first sample of the music.
  Journal(int bytes_per_sample, int64_t first_sample)
      : bytes_per_sample_(bytes_per_sample), end_sample_(first_sample) {}

  /// Splits music into pieces, and numbers their samples; a file's samples are bytes.
  void Append(v1::StreamDanceRequest request);
  /// Returns the next request that the present server has not received, or null.
  Request TakeNext();
  /// Restarts at the first request, for another server.
  void Rewind() { next_ = 0; }
  /// Discards music before this sample, which another server would not need.
  void ForgetMusicBefore(int64_t sample);
  /// The first sample still stored.
  int64_t first_sample() const;

 private:
  void Add(v1::StreamDanceRequest request);

  int bytes_per_sample_;
  int64_t end_sample_;
  std::vector<Request> requests_;
  size_t next_ = 0;
};

}  // namespace choreo::client
