#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// Computes power spectra of real signals of one length in double precision, by Fourier transforms
/// with decimation in time (Cooley and Tukey 1965), four samples or butterflies at a time. All CPUs
/// give the same bits, which equal kissfft's in golden files. Not thread-safe: it holds work space.
class FourierPower {
 public:
  /// `size`: samples, a power of two from 32 on.
  explicit FourierPower(size_t size);

  /// The squared magnitudes of the size / 2 + 1 bins from 0 to the Nyquist frequency, unscaled;
  /// valid until the next call.
  std::span<const double> Of(std::span<const double> samples);

 private:
  /// A stage that joins four transforms of `length` into one. Its twiddle factors are the second,
  /// third and fourth transform's: each the real parts, then the imaginary ones.
  struct Stage {
    size_t length;
    std::vector<double> twiddles;
  };

  size_t half_;                   // complex numbers: the signal's samples in pairs
  size_t block_;                  // of them, transformed at first, all blocks together
  std::vector<uint32_t> order_;   // by place in the blocks, the number of the pair
  std::vector<double> twiddles_;  // of the first stage of fours
  std::vector<Stage> stages_;     // the others
  std::vector<double> unmix_re_, unmix_im_;
  std::vector<double> by_place_re_, by_place_im_;  // [place in a block][block]
  std::vector<double> re_, im_, power_;
};

}  // namespace choreo
