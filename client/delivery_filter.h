#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"

namespace choreo::client {

/// A key's id, and its frame at the model's rate.
using KeyPlace = std::pair<std::string, int64_t>;

/// Filters out the frames and events that a resumed dance repeats, so that the caller receives each
/// once. Not thread-safe.
class DeliveryFilter {
 public:
  explicit DeliveryFilter(int64_t next_frame) : next_frame_(next_frame) {}

  /// The next frame to be delivered, at the output rate.
  int64_t next_frame() const { return next_frame_; }
  /// Prepares for another server, which continues from `frame` (at the model's rate) and receives
  /// all messages again. `late`: the keys before `frame`, each as often as it was sent. The new
  /// server reports them as rejected or as reached.
  void Restart(int64_t frame, std::vector<KeyPlace> late);
  /// Removes the frames that were delivered already. Returns false if none is left. Throws
  /// Error(kInternal) if frames are missing.
  bool Admit(v1::Frames* frames);
  /// Returns false for an event that was delivered already, or of a kind unknown to this version.
  bool Admit(const v1::Event& event);

 private:
  bool TakeExpected(const KeyPlace& place);

  int64_t next_frame_;
  std::multiset<KeyPlace> rejected_;  // delivered
  std::multiset<KeyPlace> expected_;  // answers that the present server has yet to repeat
  std::set<KeyPlace> reached_;
  std::set<std::pair<std::string, int64_t>> warnings_;
  double last_beat_s_ = -1;
};

}  // namespace choreo::client
