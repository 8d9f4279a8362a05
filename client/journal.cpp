#include "client/journal.h"

#include <algorithm>

namespace choreo::client {
namespace {

/// Small enough for a dance to begin early, large enough to be cheap.
constexpr size_t kMusicChunkBytes = size_t{128} * 1024;

}  // namespace

void Journal::Add(v1::StreamDanceRequest request) {
  requests_.push_back(std::make_shared<const v1::StreamDanceRequest>(std::move(request)));
}

void Journal::Append(v1::StreamDanceRequest request) {
  if (!request.has_audio()) return Add(std::move(request));
  const auto unit = static_cast<size_t>(std::max(1, bytes_per_sample_));
  const size_t chunk = std::max<size_t>(1, kMusicChunkBytes / unit) * unit;
  const std::string& bytes = request.audio().data();
  for (size_t first = 0; first < bytes.size(); first += chunk) {
    v1::StreamDanceRequest piece;
    piece.mutable_audio()->set_data(bytes.substr(first, chunk));
    piece.mutable_audio()->set_first_sample(end_sample_);
    end_sample_ += static_cast<int64_t>(piece.audio().data().size() / unit);
    Add(std::move(piece));
  }
}

Journal::Request Journal::TakeNext() {
  return next_ < requests_.size() ? requests_[next_++] : nullptr;
}

void Journal::ForgetMusicBefore(int64_t sample) {
  if (bytes_per_sample_ == 0) return;
  const auto is_past = [&](const Request& request) {
    if (!request->has_audio()) return false;
    const v1::Audio& audio = request->audio();
    return audio.first_sample() + static_cast<int64_t>(audio.data().size()) / bytes_per_sample_ <=
           sample;
  };
  // Keeps all unsent messages: the present server still needs them.
  const auto sent_end = requests_.begin() + static_cast<std::ptrdiff_t>(next_);
  const auto kept_end = std::remove_if(requests_.begin(), sent_end, is_past);
  next_ = static_cast<size_t>(kept_end - requests_.begin());
  requests_.erase(kept_end, sent_end);
}

int64_t Journal::first_sample() const {
  const auto music = std::find_if(requests_.begin(), requests_.end(),
                                  [](const Request& request) { return request->has_audio(); });
  return music == requests_.end() ? end_sample_ : (*music)->audio().first_sample();
}

}  // namespace choreo::client
