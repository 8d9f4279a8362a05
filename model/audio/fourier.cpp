#include "model/audio/fourier.h"

#include <unsupported/Eigen/FFT>
#include <vector>

namespace choreo {

struct RealFourier::State {
  int size;
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> bins;
};

RealFourier::RealFourier(int size)
    : state_(new State{size, {}, std::vector<std::complex<double>>(static_cast<size_t>(size))}) {
  state_->fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
}

RealFourier::~RealFourier() = default;
RealFourier::RealFourier(RealFourier&&) noexcept = default;
RealFourier& RealFourier::operator=(RealFourier&&) noexcept = default;

std::span<std::complex<double>> RealFourier::Forward(std::span<const double> samples) {
  state_->fft.fwd(state_->bins.data(), samples.data(), state_->size);
  return std::span(state_->bins).first(static_cast<size_t>(state_->size / 2 + 1));
}

void RealFourier::Inverse(std::span<double> samples) {
  state_->fft.inv(samples.data(), state_->bins.data(), state_->size);
}

}  // namespace choreo
