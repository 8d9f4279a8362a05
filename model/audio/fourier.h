#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace choreo {

/// Fourier transforms of real signals of one length, in double precision. Holds work space: use one
/// per thread.
class RealFourier {
 public:
  /// `size`: an even number of samples.
  explicit RealFourier(size_t size) : bins_(size) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }

  /// Returns the size / 2 + 1 bins from 0 to the Nyquist frequency of `size` samples, unscaled;
  /// valid until the next call.
  std::span<std::complex<double>> Forward(std::span<const double> samples) {
    fft_.fwd(bins_.data(), samples.data(), std::ssize(bins_));
    return std::span(bins_).first(bins_.size() / 2 + 1);
  }
  /// Transforms the bins that Forward returned (the caller may have changed them) back to samples,
  /// scaled by 1 / size.
  void Inverse(std::span<double> samples) {
    fft_.inv(samples.data(), bins_.data(), std::ssize(bins_));
  }

 private:
  Eigen::FFT<double> fft_;
  std::vector<std::complex<double>> bins_;
};

}  // namespace choreo
