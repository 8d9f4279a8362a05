#pragma once

#include <complex>
#include <memory>
#include <span>

namespace choreo {

/// Fourier transforms of real signals of one length, in double precision. Holds work space: one a
/// thread.
class RealFourier {
 public:
  explicit RealFourier(int size);  ///< an even number of samples
  ~RealFourier();
  RealFourier(RealFourier&&) noexcept;
  RealFourier& operator=(RealFourier&&) noexcept;

  /// size samples -> the size / 2 + 1 bins from 0 to the Nyquist frequency, unscaled; valid until
  /// the next call.
  std::span<std::complex<double>> Forward(std::span<const double> samples);
  /// What Forward returned, or the caller made of it -> the samples, scaled by 1 / size.
  void Inverse(std::span<double> samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace choreo
