#include "client/delivery_filter.h"

#include "model/core/error.h"

namespace choreo::client {

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

// Rejections depend on the order of the messages alone, so every server sends the same ones, in
// this order. A resumed server also rejects, as already danced, keys that the first server
// accepted; those are left out.
bool DeliveryFilter::AdmitRejection(const v1::Event& event) {
  const bool is_danced = event.keyframe_rejected().code() == v1::REJECTION_CODE_ALREADY_DANCED;
  if (is_danced && event.frame() >= first_frame_) return false;
  if (repeats_ > 0) {
    --repeats_;
    return false;
  }
  ++rejections_;
  return true;
}

bool DeliveryFilter::Admit(const v1::Event& event) {
  if (event.has_keyframe_rejected()) return AdmitRejection(event);
  if (event.has_keyframe_reached())
    return reached_.emplace(event.keyframe_reached().id(), event.frame()).second;
  if (event.has_warning())
    return warnings_.emplace(event.warning().message(), event.frame()).second;
  if (!event.has_beat() || event.time() <= last_beat_s_) return false;
  last_beat_s_ = event.time();
  return true;
}

}  // namespace choreo::client
