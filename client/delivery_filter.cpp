#include "client/delivery_filter.h"

#include "model/core/error.h"

namespace choreo::client {

void DeliveryFilter::Restart(int64_t frame, std::vector<KeyPlace> late) {
  expected_ = {late.begin(), late.end()};
  for (const KeyPlace& place : rejected_) {
    // Keys without a frame are not among `late`.
    if (place.second >= frame || place.second < 0) expected_.insert(place);
  }
}

bool DeliveryFilter::Admit(v1::Frames* frames) {
  if (frames->first_frame() > next_frame_) {
    throw Error(ErrorCode::kInternal, "",
                "the server left out frames: " + std::to_string(frames->first_frame()) +
                    " came where " + std::to_string(next_frame_) + " was due");
  }
  const int64_t known = next_frame_ - frames->first_frame();
  const int64_t left = frames->count() - known;
  if (left <= 0) return false;
  for (auto* numbers :
       {frames->mutable_root_positions(), frames->mutable_rotations(), frames->mutable_contacts()})
    numbers->erase(numbers->begin(),
                   numbers->begin() + known * (numbers->size() / frames->count()));
  frames->set_first_frame(next_frame_);
  frames->set_count(static_cast<int32_t>(left));
  next_frame_ += left;
  return true;
}

bool DeliveryFilter::TakeExpected(const KeyPlace& place) {
  const auto expected = expected_.find(place);
  if (expected == expected_.end()) return false;
  expected_.erase(expected);
  return true;
}

bool DeliveryFilter::Admit(const v1::Event& event) {
  if (event.has_keyframe_rejected()) {
    const KeyPlace place = {event.keyframe_rejected().id(), event.frame()};
    if (TakeExpected(place)) return false;
    rejected_.insert(place);
    return true;
  }
  if (event.has_keyframe_reached()) {
    const KeyPlace place = {event.keyframe_reached().id(), event.frame()};
    TakeExpected(place);
    return reached_.insert(place).second;
  }
  if (event.has_warning())
    return warnings_.emplace(event.warning().message(), event.frame()).second;
  if (!event.has_beat() || event.time() <= last_beat_s_) return false;
  last_beat_s_ = event.time();
  return true;
}

}  // namespace choreo::client
