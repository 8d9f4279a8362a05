#include "model/audio/beats/harmony.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/audio/signal/format.h"
#include "model/audio/signal/fourier.h"

namespace choreo {
namespace {

using Chroma = Eigen::Matrix<double, kChroma, 1>;

constexpr double kMinTone_hz = 60, kMaxTone_hz = 4000, kConcertPitch_hz = 440;
constexpr int kWindow = 4096;
constexpr int64_t kHop = kWindow / 2;
constexpr double kClearly = 3;  // standard errors of a difference

/// Hears the harmony of stretches of music.
class Listener {
 public:
  explicit Listener(std::span<const float> mono) : mono_(mono) {
    for (int bin = 0; bin <= kWindow / 2; ++bin)
      chroma_of_.push_back(ChromaOf(double{1} * bin * kModelSampleRate / kWindow));
  }

  /// The harmony of samples [from, to), of length 1; 0 if there is none.
  Chroma Hear(int64_t from, int64_t to) {
    Chroma sum = Chroma::Zero();
    int windows = 0;
    for (int64_t at = from; at == from || at + kWindow <= to; at += kHop, ++windows)
      AddTo(at, &sum);
    Chroma chroma = (1 + 10 * sum.array() / windows).log();
    chroma.array() -= chroma.mean();
    return chroma.normalized();
  }

 private:
  void AddTo(int64_t first, Chroma* sum) {
    for (int i = 0; i < kWindow; ++i) {
      const int64_t at = first + i;
      const bool is_heard = at >= 0 && at < std::ssize(mono_);
      windowed_[static_cast<size_t>(i)] =
          (is_heard ? double{mono_[static_cast<size_t>(at)]} : 0) *
          (0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / kWindow));
    }
    const auto powers = fourier_.Of(windowed_);
    for (size_t bin = 0; bin < powers.size(); ++bin)
      if (chroma_of_[bin] >= 0) (*sum)[chroma_of_[bin]] += std::sqrt(powers[bin]);
  }

  std::span<const float> mono_;
  std::vector<int> chroma_of_;  // by bin
  FourierPower fourier_{kWindow};
  std::vector<double> windowed_ = std::vector<double>(kWindow);
};

/// How much harmony changes on one beat of the bar.
struct Change {
  double sum = 0, squares = 0, count = 0;

  void Add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
  /// The square of the mean's standard error.
  double error() const {
    return count > 1 ? std::max(0.0, squares / count - mean() * mean()) / (count - 1) : INFINITY;
  }
};

}  // namespace

int ChromaOf(double hz) {
  if (!(hz > kMinTone_hz && hz < kMaxTone_hz)) return -1;
  const long tone = std::lround(kChroma * std::log2(hz / kConcertPitch_hz));
  return static_cast<int>((tone % kChroma + kChroma) % kChroma);
}

void CountByHarmony(std::span<const float> mono, std::vector<BarPointer::Step>* path) {
  constexpr size_t kMostBeats = 4;
  Listener listener(mono);
  std::array<Change, kMostBeats> changes;
  Chroma before = Chroma::Zero();
  for (size_t i = 0; i + 1 < path->size(); ++i) {
    const Chroma chroma =
        listener.Hear((*path)[i].frame * kOnsetHop, (*path)[i + 1].frame * kOnsetHop);
    if (i > 0) changes[static_cast<size_t>((*path)[i].in_bar)].Add(1 - chroma.dot(before));
    before = chroma;
  }
  const Change& first = changes.front();
  const auto most = std::ranges::max_element(changes, {}, &Change::mean);
  const double ahead = most->mean() - first.mean();
  if (!(ahead > kClearly * std::sqrt(most->error() + first.error()))) return;
  const auto later = static_cast<int>(most - changes.begin());
  for (BarPointer::Step& step : *path)
    step.in_bar = (step.in_bar + step.beats - later) % step.beats;
}

}  // namespace choreo
