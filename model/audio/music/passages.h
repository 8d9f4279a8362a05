#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/audio/beats/harmony.h"
#include "model/audio/signal/format.h"
#include "model/audio/signal/fourier.h"
#include "model/core/passage.h"

namespace choreo {

/// The conditions for music to count as repeating.
struct PassageOptions {
  /// The least similarity of two moments: the cosine of their harmony and timbre, relative to all
  /// music so far.
  double alike = 0.5;
  /// The least similarity of a passage: the sum over its seconds of the similarity above `alike`.
  double least = 1.0;
  /// The least distance of a repeat, seconds.
  double soonest = 12;
};

/// Detects, while music arrives, whether it repeats. Compares each moment's harmony (chroma) and
/// timbre (loudness by band) with all earlier moments', and follows the likeliest path through the
/// lags between them (Viterbi's algorithm over the lags of a self-similarity matrix; Müller,
/// "Fundamentals of Music Processing", chapter 4). A moment depends only on samples before its end.
/// Not thread-safe.
class PassageListener {
 public:
  /// Samples at 22 050 Hz between moments, 0.2 s.
  static constexpr int kHop = kModelSampleRate / 5;
  /// Samples in a moment's window, from its beginning on.
  static constexpr int kWindow = 4096;
  static constexpr double kMomentSeconds = static_cast<double>(kHop) / kModelSampleRate;

  explicit PassageListener(const PassageOptions& options = {});

  /// `window`: kWindow samples starting at the next moment.
  void Add(std::span<const float> window);

  int64_t moments() const { return moments_; }
  /// The distance, in moments, from the last moment back to the one that it repeats; none if it is
  /// new.
  std::optional<int64_t> Lag() const;
  /// All passages, using the likeliest path kTempoWindowSeconds after each moment.
  std::vector<Passage> Passages() const;

 private:
  static constexpr int kBands = 24, kNumbers = kChroma + kBands;
  using Moment = Eigen::Matrix<float, kNumbers, 1>;

  Moment Hear(std::span<const float> window);
  // The likeliest path's lag; -1 if the moment is new.
  int64_t LagAt(int64_t moment) const;
  // [moments] the last moment's similarity to each.
  Eigen::VectorXf LikenessOfLast() const;

  PassageOptions options_;
  int64_t soonest_;  // in moments
  FourierPower fourier_{kWindow};
  std::vector<double> windowed_ = std::vector<double>(kWindow);
  std::vector<int> chroma_of_, band_of_;  // by Fourier bin; -1: none

  int64_t moments_ = 0;
  Eigen::Matrix<float, kNumbers, Eigen::Dynamic> heard_;  // has room for more than moments_
  Moment sum_ = Moment::Zero(), squares_ = Moment::Zero();
  std::vector<bool> sounds_;

  // By lag, and for none: the score of the best path that ends there.
  std::vector<double> worth_;
  double worth_of_none_ = 0;
  // By moment and lag: whether the best path began there. By moment: the lag from which the best
  // path to "none" came (-1: from none).
  std::vector<std::vector<bool>> begins_;
  std::vector<int64_t> ended_;
  std::vector<int64_t> best_;  // by moment, the lag where the best path ends, or -1
};

/// The passages where a whole song at 22 050 Hz repeats: ascending, disjoint, from beat to beat if
/// `beats` (seconds) are given.
std::vector<Passage> FindPassages(std::span<const float> mono, std::span<const double> beats,
                                  const PassageOptions& options = {});

}  // namespace choreo
