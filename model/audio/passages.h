#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/audio/format.h"
#include "model/audio/fourier.h"
#include "model/core/passage.h"

namespace choreo {

/// How music is found to come back.
struct PassageOptions {
  /// Of two moments: the cosine of their harmony and timbre, each against all that was heard. From
  /// this on they are alike.
  double alike = 0.5;
  /// What begins to come back must be alike for so long: the sum, over its seconds, of what it is
  /// more alike than that.
  double least = 1.0;
  /// A dancer does the same again at the soonest so many seconds later.
  double soonest = 12;
};

/// Hears whether music comes back, as it sounds: harmony (chroma) and timbre (loudness by band) of
/// each moment are compared with those of all before it, and the likeliest way through the lags
/// between both is followed (Viterbi's algorithm over the lags of a self-similarity matrix; Müller,
/// "Fundamentals of Music Processing", chapter 4). A moment depends on the samples before its end
/// alone. Not thread-safe.
class PassageListener {
 public:
  /// Samples at 22 050 Hz from one moment to the next, 0.2 s.
  static constexpr int kHop = kModelSampleRate / 5;
  /// Samples that a moment is heard in, from its begin on.
  static constexpr int kWindow = 4096;
  static constexpr double kMomentSeconds = static_cast<double>(kHop) / kModelSampleRate;

  explicit PassageListener(const PassageOptions& options = {});

  /// `window`: kWindow samples from the next moment's first on.
  void Add(std::span<const float> window);

  int64_t moments() const { return moments_; }
  /// By how many moments the last one lies behind the one that it is like; none: it is new.
  std::optional<int64_t> Lag() const;
  /// All passages: of each moment what is likeliest kTempoWindowSeconds later.
  std::vector<Passage> Passages() const;

 private:
  static constexpr int kChroma = 12, kBands = 24, kNumbers = kChroma + kBands;
  using Moment = Eigen::Matrix<float, kNumbers, 1>;

  Moment Hear(std::span<const float> window);
  // Of the likeliest way; -1: it is new.
  int64_t LagAt(int64_t moment) const;
  // [moments], the last one's likeness to each.
  Eigen::VectorXf LikenessOfLast() const;

  PassageOptions options_;
  int64_t soonest_;  // moments
  RealFourier fourier_{kWindow};
  std::vector<double> windowed_ = std::vector<double>(kWindow);
  std::vector<int> chroma_of_, band_of_;  // by Fourier bin; -1: none

  int64_t moments_ = 0;
  Eigen::Matrix<float, kNumbers, Eigen::Dynamic> heard_;  // room for more than moments_
  Moment sum_ = Moment::Zero(), squares_ = Moment::Zero();
  std::vector<bool> sounds_;

  // Of the best way that ends with each lag, and with none: what it is worth.
  std::vector<double> worth_;
  double worth_of_none_ = 0;
  // By moment, of each lag whether the best way began there, and the best lag to come from to none
  // (-1: none before).
  std::vector<std::vector<bool>> begins_;
  std::vector<int64_t> ended_;
  std::vector<int64_t> best_;  // by moment, the lag that the best way ends with, or -1
};

/// Where a whole song at 22 050 Hz comes back: ascending, apart, from beat to beat where `beats`,
/// in seconds, says them.
std::vector<Passage> FindPassages(std::span<const float> mono, std::span<const double> beats,
                                  const PassageOptions& options = {});

}  // namespace choreo
