#include "model/audio/music/passages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "model/audio/beats/beats.h"
#include "model/audio/music/repeat_lag.h"

namespace choreo {
namespace {

constexpr double kMinBand_hz = 40, kMaxBand_hz = kModelSampleRate / 2.0;
constexpr double kSilentPower = 1e-7;  // mean square of a window: -70 dB
constexpr double kFarFromBeat_s = 0.3;
constexpr double kMoment_s = 0.5;
constexpr double kMinPassage_s = 4;  // seconds of a passage
constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

PassageListener::PassageListener(const PassageOptions& options)
    : options_(options), soonest_(std::lround(options.soonest / kMomentSeconds)) {
  for (int bin = 0; bin <= kWindow / 2; ++bin) {
    const double hz = static_cast<double>(bin) * kModelSampleRate / kWindow;
    chroma_of_.push_back(ChromaOf(hz));
    const double octaves =
        std::log2(std::max(hz, kMinBand_hz) / kMinBand_hz) / std::log2(kMaxBand_hz / kMinBand_hz);
    band_of_.push_back(std::min(kBands - 1, static_cast<int>(kBands * octaves)));
  }
}

PassageListener::Moment PassageListener::Hear(std::span<const float> window) {
  double square = 0;
  for (int i = 0; i < kWindow; ++i) {
    const double sample = window[static_cast<size_t>(i)];
    square += sample * sample;
    windowed_[static_cast<size_t>(i)] =
        sample * (0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / kWindow));
  }
  sounds_.push_back(square > kWindow * kSilentPower);
  const auto powers = fourier_.Of(windowed_);
  Eigen::Matrix<double, kNumbers, 1> sum = Eigen::Matrix<double, kNumbers, 1>::Zero();
  for (size_t bin = 0; bin < powers.size(); ++bin) {
    const double power = powers[bin];
    if (chroma_of_[bin] >= 0) sum[chroma_of_[bin]] += std::sqrt(power);
    sum[kChroma + band_of_[bin]] += power;
  }
  sum.head<kChroma>() = (1 + 10 * sum.head<kChroma>().array()).log();
  sum.head<kChroma>().array() -= sum.head<kChroma>().mean();
  sum.tail<kBands>() = (sum.tail<kBands>().array() + 1e-6).log();
  return sum.cast<float>();
}

Eigen::VectorXf PassageListener::LikenessOfLast() const {
  const auto count = static_cast<float>(moments_);
  const Eigen::Array<float, kNumbers, 1> mean = sum_.array() / count;
  const Eigen::Array<float, kNumbers, 1> unit =
      1 / (squares_.array() / count - mean.square()).max(1e-6F).sqrt();
  // Chroma values share one scale; each band has its own.
  const auto of = [&](int64_t moment) -> Moment {
    Moment seen = (heard_.col(moment).array() - mean).matrix();
    seen.tail<kBands>().array() *= unit.tail<kBands>();
    seen.head<kChroma>() /= std::max(seen.head<kChroma>().norm(), 1e-6F) * std::sqrt(2.0F);
    seen.tail<kBands>() /= std::max(seen.tail<kBands>().norm(), 1e-6F) * std::sqrt(2.0F);
    return seen;
  };
  Eigen::VectorXf likeness = Eigen::VectorXf::Zero(moments_);
  if (!sounds_.back()) {  // two silences cannot be told apart
    for (int64_t moment = 0; moment < moments_; ++moment)
      if (!sounds_[static_cast<size_t>(moment)])
        likeness[moment] = static_cast<float>(options_.alike);
    return likeness;
  }
  const Moment last = of(moments_ - 1);
  for (int64_t moment = 0; moment + soonest_ < moments_; ++moment)
    if (sounds_[static_cast<size_t>(moment)]) likeness[moment] = last.dot(of(moment));
  return likeness;
}

void PassageListener::Add(std::span<const float> window) {
  if (moments_ == heard_.cols())
    heard_.conservativeResize(Eigen::NoChange, std::max<int64_t>(256, 2 * moments_));
  heard_.col(moments_) = Hear(window);
  sum_ += heard_.col(moments_);
  squares_ += heard_.col(moments_).cwiseAbs2();
  ++moments_;

  const Eigen::VectorXf likeness = LikenessOfLast();
  const auto best = std::ranges::max_element(worth_);
  const bool ends = best != worth_.end() && *best > worth_of_none_;
  const double before = worth_of_none_;
  if (ends) worth_of_none_ = *best;
  ended_.push_back(ends ? best - worth_.begin() : -1);
  worth_.resize(static_cast<size_t>(moments_), kNever);
  begins_.emplace_back(worth_.size());
  for (int64_t lag = soonest_; lag < moments_; ++lag) {
    const auto at = static_cast<size_t>(lag);
    const double begun = before - options_.least;
    begins_.back()[at] = begun > worth_[at];
    worth_[at] = std::max(worth_[at], begun) +
                 (likeness[moments_ - 1 - lag] - options_.alike) * kMomentSeconds;
  }
  const auto now = std::ranges::max_element(worth_);
  best_.push_back(*now > worth_of_none_ ? now - worth_.begin() : -1);
}

std::optional<int64_t> PassageListener::Lag() const {
  if (moments_ == 0 || best_.back() < 0) return std::nullopt;
  return best_.back();
}

// Music more than kLater afterwards changes nothing, so the beginning of a song has passages, too.
int64_t PassageListener::LagAt(int64_t moment) const {
  constexpr int64_t kLater = kTempoWindowSeconds * kModelSampleRate / kHop;
  int64_t at = std::min(moment + kLater, moments_ - 1);
  int64_t lag = best_[static_cast<size_t>(at)];
  for (; at > moment; --at) {
    const auto here = static_cast<size_t>(at);
    if (lag < 0) {
      lag = ended_[here];
    } else if (begins_[here][static_cast<size_t>(lag)]) {
      lag = -1;
    }
  }
  return lag;
}

std::vector<Passage> PassageListener::Passages() const {
  const auto seconds = [](int64_t moment) { return static_cast<double>(moment) * kMomentSeconds; };
  std::vector<Passage> passages;
  int64_t before = -1;
  for (int64_t moment = 0; moment < moments_; ++moment) {
    const int64_t lag = LagAt(moment);
    if (lag >= 0 && lag != before) passages.push_back({seconds(moment), 0, seconds(moment - lag)});
    if (lag >= 0) passages.back().to = seconds(moment + 1);
    before = lag;
  }
  return passages;
}

std::vector<Passage> FindPassages(std::span<const float> mono, std::span<const double> beats,
                                  const PassageOptions& options) {
  PassageListener listener(options);
  std::vector<float> window(PassageListener::kWindow);
  for (size_t from = 0; from < mono.size(); from += PassageListener::kHop) {
    const auto part = mono.subspan(from, std::min(window.size(), mono.size() - from));
    std::ranges::fill(std::ranges::copy(part, window.begin()).out, window.end(), 0.0F);
    listener.Add(window);
  }
  // Moves to the nearest beat, if there is one.
  const auto on_beat = [&](double second) {
    const auto nearest = std::ranges::min_element(
        beats, {}, [second](double beat) { return std::abs(beat - second); });
    return nearest != beats.end() && std::abs(*nearest - second) < kFarFromBeat_s ? *nearest
                                                                                  : second;
  };
  const std::vector<Passage> all = listener.Passages();
  if (all.empty()) return {};
  RepeatLag lags;
  lags.Hear(mono);
  std::vector<Passage> passages;
  for (const Passage& found : all) {
    Passage passage{on_beat(found.from), on_beat(found.to)};
    // Beats of both times may have other phases near a change, so the lag is heard.
    passage.like = passage.from - lags.Near(found.from - found.like, found.from, found.to);
    if (passage.like < 0) {
      passage.from -= passage.like;
      passage.like = 0;
    }
    if (!passages.empty() && passage.from < passages.back().to) {
      passage.like += passages.back().to - passage.from;
      passage.from = passages.back().to;
    }
    // A passage within a moment of the song's start or of another passage's end begins there.
    const double least = passages.empty() ? 0 : passages.back().to - kMoment_s;
    for (size_t i = 0; i <= passages.size(); ++i) {
      const double ahead = passage.like - (i == 0 ? 0 : passages[i - 1].from);
      if (std::abs(ahead) >= kMoment_s || passage.from - ahead < least) continue;
      passage.from -= ahead;
      passage.like -= ahead;
      if (!passages.empty()) passages.back().to = std::min(passages.back().to, passage.from);
      break;
    }
    if (passage.to - passage.from >= kMinPassage_s && passage.like < passage.from)
      passages.push_back(passage);
  }
  return passages;
}

}  // namespace choreo
