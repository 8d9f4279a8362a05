#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "choreo/v1/choreography.pb.h"

namespace choreo::client {

/// Filters out the frames and events that a resumed dance repeats, so that the caller receives each
/// once. Not thread-safe.
class DeliveryFilter {
 public:
  /// `first_frame`: the dance's, at the model's rate. `next_frame`: the same at the output rate.
  DeliveryFilter(int64_t first_frame, int64_t next_frame)
      : first_frame_(first_frame), next_frame_(next_frame) {}

  /// The next frame to be delivered, at the output rate.
  int64_t next_frame() const { return next_frame_; }
  /// Prepares for another server, which receives all messages again.
  void Restart() { repeats_ = rejections_; }
  /// Removes the frames that were delivered already. Returns false if none is left. Throws
  /// Error(kInternal) if frames are missing.
  bool Admit(v1::Frames* frames);
  /// Returns false for an event that was delivered already, or of a kind unknown to this version.
  bool Admit(const v1::Event& event);

 private:
  bool AdmitRejection(const v1::Event& event);

  int64_t first_frame_;
  int64_t next_frame_;
  int rejections_ = 0;  // delivered
  int repeats_ = 0;     // rejections that the present server has yet to repeat
  std::set<std::pair<std::string, int64_t>> reached_;
  std::set<std::pair<std::string, int64_t>> warnings_;
  double last_beat_s_ = -1;
};

}  // namespace choreo::client
