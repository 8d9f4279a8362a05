#include "client/delivery_filter.h"

namespace choreo::client {

void DeliveryFilter::Restart(int64_t frame, std::vector<KeyPlace> late) {
  expected_ = {late.begin(), late.end()};
  for (const KeyPlace& place : rejected_) {
    // Keys without a frame are not among `late`.
    if (place.second >= frame || place.second < 0) expected_.insert(place);
  }
}

bool DeliveryFilter::Admit(FrameBlock* block) {
  if (block->first_frame > next_frame_) {
    throw Error(ErrorCode::kInternal, "",
                "the server left out frames: " + std::to_string(block->first_frame) +
                    " came where " + std::to_string(next_frame_) + " was due");
  }
  const auto known = static_cast<std::ptrdiff_t>(next_frame_ - block->first_frame);
  if (known >= static_cast<std::ptrdiff_t>(block->poses.size())) return false;
  block->poses.erase(block->poses.begin(), block->poses.begin() + known);
  block->contacts.erase(block->contacts.begin(), block->contacts.begin() + known);
  block->first_frame = next_frame_;
  next_frame_ += static_cast<int64_t>(block->poses.size());
  return true;
}

bool DeliveryFilter::TakeExpected(const KeyPlace& place) {
  const auto expected = expected_.find(place);
  if (expected == expected_.end()) return false;
  expected_.erase(expected);
  return true;
}

bool DeliveryFilter::Admit(const DanceEvent& event) {
  if (const auto* rejected = std::get_if<KeyRejected>(&event)) {
    const KeyPlace place = {rejected->id, rejected->frame};
    if (TakeExpected(place)) return false;
    rejected_.insert(place);
    return true;
  }
  if (const auto* reached = std::get_if<KeyReached>(&event)) {
    const KeyPlace place = {reached->id, reached->frame};
    TakeExpected(place);
    return reached_.insert(place).second;
  }
  if (const auto* warning = std::get_if<Warning>(&event)) {
    return warnings_.emplace(warning->message, warning->frame).second;
  }
  if (const auto* beat = std::get_if<Beat>(&event)) {
    if (beat->time_s <= last_beat_s_) return false;
    last_beat_s_ = beat->time_s;
  }
  return true;
}

}  // namespace choreo::client
