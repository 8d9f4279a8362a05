#include "model/audio/music/feature_stream.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include "model/audio/signal/format.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr int64_t kHalfWindow = kFftSize / 2;
static_assert(kHalfWindow + (kRowOnsets - 1) * kOnsetHop + kOnsetWindow / 2 <= kFftSize);
constexpr size_t kBlock = 1024;  // frames of samples

int64_t CeilDivide(int64_t value, int64_t by) { return (value + by - 1) / by; }

}  // namespace

FeatureStream::FeatureStream(double sample_rate, int channels, int64_t first_sample)
    : sample_rate_(sample_rate),
      channels_(channels),
      first_sample_(first_sample),
      resampler_(sample_rate, channels, first_sample),
      mono_start_(resampler_.first_output()) {
  if (mono_start_ == 0) {
    mono_.assign(kHalfWindow, 0.0f);
    mono_start_ = -kHalfWindow;
  }
  first_row_ = CeilDivide(mono_start_ + kHalfWindow, kFeatureHop);
  silence_ = RowOf(std::vector<float>(kFftSize), nullptr);
}

void FeatureStream::Push(std::span<const float> interleaved) {
  // Pieces are small: a stream keeps the memory of its largest one.
  const size_t block = kBlock * static_cast<size_t>(channels_);
  for (size_t at = 0; at < interleaved.size(); at += block) {
    resampler_.Push(interleaved.subspan(at, std::min(block, interleaved.size() - at)));
    resampler_.Pull(mono_);
    ComputeRows();
  }
  pushed_ += std::ssize(interleaved) / channels_;
}

void FeatureStream::Finish() {
  if (finished_) return;
  finished_ = true;
  resampler_.Finish();
  resampler_.Pull(mono_);
  // Adds silence up to the last window that holds any audio; all rows after it are equal.
  mono_.insert(mono_.end(), kFftSize + kFeatureHop, 0.0f);
  ComputeRows();
  mono_ = {};
}

void FeatureStream::ComputeRows() {
  const int64_t end = mono_start_ + static_cast<int64_t>(mono_.size());
  int64_t start = 0;
  for (;;) {
    start = (first_row_ + static_cast<int64_t>(rows_.size())) * kFeatureHop - kHalfWindow;
    if (start + kFftSize > end) break;
    rows_.push_back(
        RowOf(std::span(mono_).subspan(static_cast<size_t>(start - mono_start_)), &beginnings_));
  }
  const int64_t done = std::min(start, end) - mono_start_;
  if (done > 0) {
    mono_.erase(mono_.begin(), mono_.begin() + done);
    mono_start_ += done;
  }
}

FeatureStream::RowValues FeatureStream::RowOf(std::span<const float> samples,
                                              Beginnings* beginnings) {
  // Shared per thread: its work space is several times the size of a stream.
  thread_local MelSpectrum spectrum;
  RowValues row{.bands = spectrum.Decibels(samples), .sound = {}};
  if (beginnings == nullptr) return row;
  row.sound = PowersOf(spectrum.WithoutDc(samples, row.bands));
  row.sound.onset = beginnings->rows.Add(row.bands);
  for (size_t i = 0; i < kRowOnsets; ++i) {
    const size_t centre = kHalfWindow + i * kOnsetHop;
    row.sound.onsets[i] =
        beginnings->frames.Add(samples.subspan(centre - kOnsetWindow / 2, kOnsetWindow));
  }
  return row;
}

int64_t FeatureStream::final_rows() const {
  if (finished_) return std::numeric_limits<int64_t>::max();
  return first_row_ + static_cast<int64_t>(rows_.size());
}

int64_t FeatureStream::audio_rows() const {
  if (next_sample() == 0) return 0;
  const int64_t mono =
      CeilDivide(next_sample() * kModelSampleRate, static_cast<int64_t>(sample_rate_));
  return 1 + mono / kFeatureHop;
}

const MelBandsDb& FeatureStream::Bands(int64_t row) const { return ValuesOf(row).bands; }
const RowSound& FeatureStream::Sound(int64_t row) const { return ValuesOf(row).sound; }

const FeatureStream::RowValues& FeatureStream::ValuesOf(int64_t row) const {
  if (row < first_row_ || row >= final_rows()) {
    throw Error(ErrorCode::kOutOfRange, "audio row",
                std::to_string(row) + " is not within " + std::to_string(first_row_) + " to " +
                    std::to_string(final_rows() - 1) + ", the rows that are final");
  }
  const int64_t index = row - first_row_;
  return index < static_cast<int64_t>(rows_.size()) ? rows_[static_cast<size_t>(index)] : silence_;
}

void FeatureStream::Forget(int64_t row) {
  for (; first_row_ < row && !rows_.empty(); ++first_row_) rows_.pop_front();
}

int FeatureStream::latency_samples() const {
  return static_cast<int>(kHalfWindow + resampler_.latency());
}

int64_t FeatureStream::FirstSampleFor(int64_t row, double sample_rate) {
  const int64_t before =
      std::max<int64_t>(Resampler(sample_rate, 1).half_length() - 1, 0);  // checks the rate
  const int64_t first_mono = row * kFeatureHop - kHalfWindow;
  if (first_mono <= 0) return 0;
  const int64_t rate = static_cast<int64_t>(sample_rate);
  return std::max<int64_t>(first_mono * rate / kModelSampleRate - before, 0);
}

std::vector<RowSound> SoundsOf(std::span<const float> mono) {
  FeatureStream stream(kModelSampleRate, 1);
  stream.Push(mono);
  stream.Finish();
  std::vector<RowSound> rows;
  for (int64_t row = 0; row < stream.audio_rows(); ++row) rows.push_back(stream.Sound(row));
  return rows;
}

}  // namespace choreo
