#include "model/audio/music/row_sound.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "model/audio/signal/format.h"

namespace choreo {
namespace {

constexpr double kMinPower = 1e-12;  // lower bound of logarithms' arguments

// One of BS.1770's two K filters, second order, with its printed coefficients at 48 kHz; gives its
// power gain at a frequency.
struct Biquad {
  double b0, b1, b2, a1, a2;

  double GainAt(double hz) const {
    const auto z = std::polar(1.0, -2 * std::numbers::pi * hz / 48000);
    return std::norm((b0 + z * (b1 + z * b2)) / (1.0 + z * (a1 + z * a2)));
  }
};
constexpr Biquad kHead{1.53512485958697, -2.69169618940638, 1.19839281085285, -1.69065929318241,
                       0.73248077421585};
constexpr Biquad kHighPass{1, -2, 1, -1.99004745483398, 0.99007225036621};

// Weights of each band's power.
struct Shares {
  std::array<double, kMelBands> plain{}, weighted{};

  Shares() {
    // Inverse of a Hann window's mean square.
    constexpr double kWindow = 2.0 / (kFftSize * (3.0 / 8 * kFftSize));
    for (size_t band = 0; band < kMelBands; ++band) {
      const MelBand at = MelBandAt(band);
      // Triangles of height 1 sum to the whole spectrum.
      plain[band] = kWindow * (at.high_hz - at.low_hz) / 2;
      weighted[band] = plain[band] * kHead.GainAt(at.centre_hz) * kHighPass.GainAt(at.centre_hz);
    }
  }
};

}  // namespace

RowSound PowersOf(const MelBandsDb& db) {
  static const Shares kShares;
  double power = 0, bass = 0;
  for (size_t band = 0; band < kMelBands; ++band) {
    const double of_band = std::exp(db[band] * (std::numbers::ln10 / 10));
    power += kShares.weighted[band] * of_band;
    if (band < kBassBands) bass += kShares.plain[band] * of_band;
  }
  return {.power = static_cast<float>(power), .bass = static_cast<float>(bass)};
}

double Loudness(double power) { return -0.691 + 10 * std::log10(std::max(power, kMinPower)); }

}  // namespace choreo
