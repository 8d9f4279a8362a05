#include "model/dance/input/audio_feed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo {
namespace {

Eigen::VectorXf RowOf(const MusicFeatures& features, const FeatureStream& music, int64_t at) {
  Eigen::VectorXf row(features.count);
  features.row(music.Bands(at), {row.data(), static_cast<size_t>(features.count)});
  return row;
}

// The largest distances of samples from their channel's offset, and of the sums of the channels.
struct Peaks {
  float level = 0, sum = 0;
};

template <typename Channels>
Peaks PeaksOf(std::span<const float> interleaved, std::span<const float> offsets,
              Channels channels) {
  constexpr size_t kLanes = 16;  // frames processed independently of each other
  std::array<float, kLanes> level{}, sum{};
  const auto add = [&](size_t at, size_t lane) {
    float mixed = 0;
    for (size_t channel = 0; channel < channels; ++channel) {
      const float sample = interleaved[at + channel] - offsets[channel];
      level[lane] = std::max(level[lane], std::abs(sample));
      mixed += sample;
    }
    sum[lane] = std::max(sum[lane], std::abs(mixed));
  };
  size_t at = 0;
  for (; at + kLanes * channels <= interleaved.size(); at += kLanes * channels) {
    for (size_t lane = 0; lane < kLanes; ++lane) add(at + lane * channels, lane);
  }
  for (; at < interleaved.size(); at += channels) add(at, 0);
  return {std::ranges::max(level), std::ranges::max(sum)};
}

Peaks PeaksOf(std::span<const float> interleaved, std::span<const float> offsets) {
  const size_t channels = offsets.size();
  if (channels == 1) return PeaksOf(interleaved, offsets, std::integral_constant<size_t, 1>());
  if (channels == 2) return PeaksOf(interleaved, offsets, std::integral_constant<size_t, 2>());
  return PeaksOf<size_t>(interleaved, offsets, channels);
}

Eigen::VectorXf RowOfSilence(const MusicFeatures& features) {
  if (!features) return {};
  FeatureStream silence(kModelSampleRate, 1);
  silence.Finish();
  return RowOf(features, silence, 0);
}

}  // namespace

void CheckSamples(std::span<const float> interleaved, int channels, int64_t first_sample) {
  if (interleaved.size() % static_cast<size_t>(channels) != 0) {
    throw InvalidArgument("samples", std::to_string(interleaved.size()) +
                                         " values are not a multiple of the " +
                                         std::to_string(channels) + " channels");
  }
  CheckLevels(interleaved, channels, first_sample, "samples");
}

AudioFeed::AudioFeed(double sample_rate, int channels, int64_t first_sample, MusicFeatures features)
    : sample_rate_(sample_rate),
      channels_(channels),
      features_(sample_rate, channels, first_sample),
      music_features_(features),
      silence_(RowOfSilence(features)),
      whole_(first_sample == 0),
      offsets_(static_cast<size_t>(channels)),
      first_row_(features_.first_row()),
      ready_(first_row_),
      published_(first_row_),
      first_sound_(first_row_ > 0 ? first_row_ + kRowSoundMemory : 0) {}

void AudioFeed::Push(std::span<const float> interleaved, int64_t first_sample,
                     const std::function<void()>& on_rows) {
  if (features_.finished()) {
    throw Error(ErrorCode::kFailedPrecondition, "push_audio", "comes after the end of the music");
  }
  const int64_t expected = features_.next_sample();
  if (first_sample != expected) {
    throw Error(ErrorCode::kOutOfRange, "first_sample",
                std::to_string(first_sample) +
                    (first_sample > expected ? " leaves a gap" : " overlaps") +
                    ": the sample expected is " + std::to_string(expected));
  }
  CheckSamples(interleaved, channels_, expected);
  const size_t channels = static_cast<size_t>(channels_);
  const int64_t end = expected + static_cast<int64_t>(interleaved.size() / channels);
  if (static_cast<double>(end) > kMaxAudioSeconds * sample_rate_) {
    throw InvalidArgument("samples", "ends at " + InFull(static_cast<double>(end) / sample_rate_) +
                                         " s, the limit is " + InFull(kMaxAudioSeconds) + " s");
  }
  if (expected == 0 && !interleaved.empty())
    std::copy_n(interleaved.begin(), channels, offsets_.begin());
  const Peaks peaks = PeaksOf(interleaved, offsets_);
  peak_ = std::max(peak_, peaks.level);
  mixed_peak_ = std::max(mixed_peak_, peaks.sum / static_cast<float>(channels));
  const size_t second = static_cast<size_t>(sample_rate_) * channels;
  while (!interleaved.empty()) {
    const auto next = interleaved.first(std::min(second, interleaved.size()));
    features_.Push(next);
    interleaved = interleaved.subspan(next.size());
    Publish();
    on_rows();
  }
}

void AudioFeed::Finish() {
  features_.Finish();
  Publish();
}

int64_t AudioFeed::EndFrame(double fps) const {
  return static_cast<int64_t>(
      std::ceil(static_cast<double>(features_.next_sample()) * fps / sample_rate_));
}

void AudioFeed::Publish() {
  // Windows more than two rows past the last row centred within the audio no longer reach it.
  constexpr int64_t kTail = 3;
  const int64_t computed = features_.final_rows();
  std::lock_guard lock(mutex_);
  const int64_t end = std::min(computed, features_.audio_rows() + kTail);
  for (; published_ < end; ++published_) {
    if (music_features_) rows_.push_back(RowOf(music_features_, features_, published_));
    if (published_ >= first_sound_) sounds_.push_back(features_.Sound(published_));
  }
  features_.Forget(end);
  ready_ = computed;
}

int64_t AudioFeed::ready() const {
  std::lock_guard lock(mutex_);
  return ready_;
}

const Eigen::VectorXf& AudioFeed::Heard(int64_t row) const {
  if (row >= ready_ || (row >= 0 && row < first_row_)) {
    throw Error(ErrorCode::kInternal, "",
                "audio row " + std::to_string(row) + " is no longer kept, or was never sent");
  }
  if (row < 0 || row >= published_) return silence_;
  return rows_[static_cast<size_t>(row - first_row_)];
}

void AudioFeed::Forget(int64_t row) {
  std::lock_guard lock(mutex_);
  const int64_t first_kept = std::clamp(row, first_row_, published_);
  if (music_features_) rows_.erase(rows_.begin(), rows_.begin() + (first_kept - first_row_));
  first_row_ = first_kept;
  for (; first_sound_ < row - kSoundMemory && !sounds_.empty(); ++first_sound_) sounds_.pop_front();
}

std::vector<RowSound> AudioFeed::Sounds(int64_t row, int count) const {
  std::lock_guard lock(mutex_);
  const int64_t known = first_sound_ + static_cast<int64_t>(sounds_.size());
  std::vector<RowSound> sounds;
  for (int64_t r = std::max(first_sound_, row - count); r < row; ++r)
    sounds.push_back(r < known ? sounds_[static_cast<size_t>(r - first_sound_)] : RowSound());
  return sounds;
}

Eigen::MatrixXf AudioFeed::History(int64_t frame, int count) const {
  Eigen::MatrixXf history(music_features_.count, count);
  std::lock_guard lock(mutex_);
  for (int i = 0; i < count; ++i) history.col(i) = Heard(frame - count + i);
  return history;
}

}  // namespace choreo
