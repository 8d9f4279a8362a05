#include "model/audio/signal/fourier.h"

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "model/core/running/each_cpu.h"

namespace choreo {
namespace {

struct Complexes {
  double* re;
  double* im;
};

// One butterfly: four numbers, the last three times their twiddle factors.
inline void Butterfly(double* re, double* im, size_t apart, double c1, double s1, double c2,
                      double s2, double c3, double s3) {
  const double r1 = re[apart] * c1 - im[apart] * s1, i1 = re[apart] * s1 + im[apart] * c1;
  const double r2 = re[2 * apart] * c2 - im[2 * apart] * s2;
  const double i2 = re[2 * apart] * s2 + im[2 * apart] * c2;
  const double r3 = re[3 * apart] * c3 - im[3 * apart] * s3;
  const double i3 = re[3 * apart] * s3 + im[3 * apart] * c3;
  const double sum_r = re[0] + r2, sum_i = im[0] + i2, rest_r = re[0] - r2, rest_i = im[0] - i2;
  const double odd_r = r1 + r3, odd_i = i1 + i3, turned_r = i1 - i3, turned_i = -(r1 - r3);
  re[0] = sum_r + odd_r;
  im[0] = sum_i + odd_i;
  re[apart] = rest_r + turned_r;
  im[apart] = rest_i + turned_i;
  re[2 * apart] = sum_r - odd_r;
  im[2 * apart] = sum_i - odd_i;
  re[3 * apart] = rest_r - turned_r;
  im[3 * apart] = rest_i - turned_i;
}

// Neighbouring butterflies of one transform, each with its own factors.
CHOREO_EACH_CPU void JoinFours(Complexes x, size_t count, size_t length, const double* twiddles) {
  double* __restrict re = x.re;
  double* __restrict im = x.im;
  const double* __restrict t = twiddles;
  for (size_t first = 0; first < count; first += 4 * length) {
#pragma GCC ivdep
    for (size_t k = 0; k < length; ++k) {
      Butterfly(re + first + k, im + first + k, length, t[k], t[length + k], t[2 * length + k],
                t[3 * length + k], t[4 * length + k], t[5 * length + k]);
    }
  }
}

// The same butterfly of all blocks.
CHOREO_EACH_CPU void FoursOfBlocks(Complexes x, size_t blocks, size_t apart, const double* t) {
  double* __restrict re = x.re;
  double* __restrict im = x.im;
  const double c1 = t[0], s1 = t[1], c2 = t[2], s2 = t[3], c3 = t[4], s3 = t[5];
#pragma GCC ivdep
  for (size_t block = 0; block < blocks; ++block)
    Butterfly(re + block, im + block, apart * blocks, c1, s1, c2, s2, c3, s3);
}
CHOREO_EACH_CPU void TwosOfBlocks(double* __restrict a, double* __restrict b, size_t blocks) {
  for (size_t block = 0; block < blocks; ++block) {
    const double difference = a[block] - b[block];
    a[block] += b[block];
    b[block] = difference;
  }
}

// Turns the transform of pairs of samples into the powers of the samples' own.
CHOREO_EACH_CPU void Unmix(const double* __restrict re, const double* __restrict im, size_t half,
                           const double* __restrict c, const double* __restrict s,
                           double* __restrict power) {
  for (size_t k = 1; k <= half / 2; ++k) {
    const size_t other = half - k;
    const double even_r = re[k] + re[other], even_i = im[k] - im[other];
    const double odd_r = re[k] - re[other], odd_i = im[k] + im[other];
    const double r = odd_r * c[k - 1] - odd_i * s[k - 1];
    const double i = odd_r * s[k - 1] + odd_i * c[k - 1];
    const double here_r = (even_r + r) * 0.5, here_i = (even_i + i) * 0.5;
    const double there_r = (even_r - r) * 0.5, there_i = (even_i - i) * 0.5;
    power[k] = here_r * here_r + here_i * here_i;
    power[other] = there_r * there_r + there_i * there_i;
  }
}

// exp(-2 pi i k / n), from angles of at most an eighth of a turn, as kissfft has it.
std::complex<double> Twiddle(size_t k, size_t n) {
  const double eighth = 0.25 * std::numbers::pi / static_cast<double>(n);
  const auto at = [&](size_t count) {
    const double angle = static_cast<double>(count) * eighth;
    return std::complex(std::cos(angle), std::sin(angle));
  };
  if (k == 0) return 1;
  if (2 * k == n) return -1;
  if (2 * k > n) return std::conj(Twiddle(n - k, n));
  if (8 * k < n) return std::conj(at(8 * k));
  if (4 * k < n) {
    const auto turn = at(2 * n - 8 * k);
    return {turn.imag(), -turn.real()};
  }
  if (8 * k < 3 * n) {
    const auto turn = at(8 * k - 2 * n);
    return {-turn.imag(), -turn.real()};
  }
  const auto turn = at(4 * n - 8 * k);
  return {-turn.real(), -turn.imag()};
}

// The factors of the second, third and fourth number, for `length` neighbouring butterflies in a
// transform of n.
std::vector<double> Twiddles(size_t length, size_t n) {
  std::vector<double> twiddles;
  for (size_t power = 1; power <= 3; ++power) {
    for (const bool imaginary : {false, true}) {
      for (size_t k = 0; k < length; ++k) {
        const auto twiddle = Twiddle(power * k * (n / (4 * length)), n);
        twiddles.push_back(imaginary ? twiddle.imag() : twiddle.real());
      }
    }
  }
  return twiddles;
}

}  // namespace

FourierPower::FourierPower(size_t size) : half_(size / 2), order_(half_), power_(half_ + 1) {
  // Uses fours as far as possible, then a two.
  std::vector<size_t> radices;
  for (size_t left = half_; left > 1; left /= radices.back())
    radices.push_back(left % 4 == 0 ? 4 : 2);
  const size_t last = radices.back();
  block_ = 4 * last;
  const std::function<void(size_t, size_t, size_t, size_t)> fill = [&](size_t stage, size_t place,
                                                                       size_t pair, size_t apart) {
    const size_t length = half_ / (apart * radices[stage]);
    for (size_t part = 0; part < radices[stage]; ++part) {
      const size_t at = place + part * length, from = pair + part * apart;
      if (length == 1) {
        order_[at] = static_cast<uint32_t>(from);
      } else {
        fill(stage + 1, at, from, apart * radices[stage]);
      }
    }
  };
  fill(0, 0, 0, 1);
  twiddles_ = Twiddles(last, half_);
  for (size_t length = block_; length < half_; length *= 4)
    stages_.push_back({length, Twiddles(length, half_)});
  const double pi = std::acos(-1.0);
  for (size_t k = 1; k <= half_ / 2; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(half_);
    const auto turn = std::exp(std::complex<double>(0, -pi * (share + 0.5)));
    unmix_re_.push_back(turn.real());
    unmix_im_.push_back(turn.imag());
  }
  for (auto* space : {&by_place_re_, &by_place_im_, &re_, &im_}) space->resize(half_);
}

std::span<const double> FourierPower::Of(std::span<const double> samples) {
  const size_t blocks = half_ / block_, last = block_ / 4;
  for (size_t block = 0; block < blocks; ++block) {
    for (size_t place = 0; place < block_; ++place) {
      const size_t pair = order_[block * block_ + place];
      by_place_re_[place * blocks + block] = samples[2 * pair];
      by_place_im_[place * blocks + block] = samples[2 * pair + 1];
    }
  }
  double* const re = by_place_re_.data();
  double* const im = by_place_im_.data();
  constexpr double kOnes[] = {1, 0, 1, 0, 1, 0};
  for (size_t first = 0; first < block_; first += last) {
    const size_t at = first * blocks;
    if (last == 4) {
      FoursOfBlocks({re + at, im + at}, blocks, 1, kOnes);
    } else {
      TwosOfBlocks(re + at, re + at + blocks, blocks);
      TwosOfBlocks(im + at, im + at + blocks, blocks);
    }
  }
  for (size_t k = 0; k < last; ++k) {
    double factors[6];
    for (size_t i = 0; i < 6; ++i) factors[i] = twiddles_[i * last + k];
    FoursOfBlocks({re + k * blocks, im + k * blocks}, blocks, last, factors);
  }
  for (size_t block = 0; block < blocks; ++block) {
    for (size_t place = 0; place < block_; ++place) {
      re_[block * block_ + place] = re[place * blocks + block];
      im_[block * block_ + place] = im[place * blocks + block];
    }
  }
  for (const Stage& stage : stages_)
    JoinFours({re_.data(), im_.data()}, half_, stage.length, stage.twiddles.data());
  const double sum = re_[0] + im_[0], difference = re_[0] - im_[0];
  Unmix(re_.data(), im_.data(), half_, unmix_re_.data(), unmix_im_.data(), power_.data());
  power_[0] = sum * sum;
  power_[half_] = difference * difference;
  return power_;
}

}  // namespace choreo
