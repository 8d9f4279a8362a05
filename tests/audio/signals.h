#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

namespace choreo {

/// amplitude * sin(2 pi hz t), sampled at `rate` from absolute sample `first` on.
inline std::vector<float> Sine(double hz, double rate, int64_t samples, double amplitude = 1.0,
                               int64_t first = 0) {
  std::vector<float> wave(static_cast<size_t>(samples));
  for (size_t i = 0; i < wave.size(); ++i) {
    const double t = static_cast<double>(first + static_cast<int64_t>(i)) / rate;
    wave[i] = static_cast<float>(amplitude * std::sin(2 * std::numbers::pi * hz * t));
  }
  return wave;
}

/// Uniform noise between -amplitude and amplitude; the same for the same seed everywhere.
inline std::vector<float> Noise(int64_t samples, uint64_t seed, double amplitude = 1.0) {
  std::vector<float> wave(static_cast<size_t>(samples));
  for (float& value : wave) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    value = static_cast<float>(amplitude * (static_cast<double>(seed >> 33) / 1073741824.0 - 1.0));
  }
  return wave;
}

/// The signal whose expected vectors in these tests were computed with NumPy: a tone, a sweep and a
/// burst every quarter of a second, 1.5 s at 22 050 Hz.
inline std::vector<float> TonesAndBursts() {
  std::vector<float> wave(3 * 22050 / 2);
  for (size_t i = 0; i < wave.size(); ++i) {
    const double t = static_cast<double>(i) / 22050.0, since = std::fmod(t, 0.25);
    const double pi = std::numbers::pi;
    wave[i] = static_cast<float>(0.3 * std::sin(2 * pi * 440 * t) +
                                 0.2 * std::sin(2 * pi * (300 * t + 1500 * t * t)) +
                                 0.4 * std::exp(-60 * since) * std::sin(2 * pi * 3000 * since));
  }
  return wave;
}

/// A short burst of noise every `period` samples from `first` on.
inline std::vector<float> Clicks(int64_t samples, int64_t first, int64_t period) {
  std::vector<float> wave(static_cast<size_t>(samples), 0.0f);
  const std::vector<float> burst = Noise(600, 5);
  for (int64_t at = first; at < samples; at += period) {
    for (int64_t i = 0; i < 600 && at + i < samples; ++i) {
      const double decay = std::exp(-static_cast<double>(i) / 120.0);
      wave[static_cast<size_t>(at + i)] =
          static_cast<float>(0.7 * decay * burst[static_cast<size_t>(i)]);
    }
  }
  return wave;
}

/// Metal at 22 050 Hz: bright, loud strokes between the beats, the bass drum on them. Beat k is at
/// second 0.3 + k * `period`.
inline std::vector<float> Metal(double seconds, double period) {
  constexpr int64_t kRate = 22050;
  std::vector<float> wave = Noise(static_cast<int64_t>(seconds * kRate), 9, 0.001);
  const std::vector<float> click = Clicks(600, 0, 600), thump = Sine(65, kRate, kRate / 8, 0.5);
  const auto add = [&wave](double second, const std::vector<float>& sound, float decay) {
    const auto at = static_cast<size_t>(second * kRate);
    for (size_t i = 0; i < sound.size() && at + i < wave.size(); ++i)
      wave[at + i] += sound[i] * std::exp(-decay * static_cast<float>(i) / kRate);
  };
  for (double beat = 0.3; beat < seconds; beat += period) {
    add(beat, thump, 30);
    add(beat + 0.5 * period, click, 0);
  }
  return wave;
}

/// Drums at 22 050 Hz, 20 s. `steps`, again and again: a letter per half beat: k bass drum, s
/// snare, b both, h hat, . nothing. The first is at second `first`.
inline std::vector<float> Drums(double first, double period, std::string_view steps) {
  constexpr int64_t kRate = 22050;
  std::vector<float> wave(20 * kRate, 0.0F);
  const std::vector<float> kick = Sine(60, kRate, kRate / 10, 0.39), hat = Noise(730, 5, 0.2),
                           snare = Noise(kRate / 8, 6, 0.25);
  for (size_t step = 0; first + static_cast<double>(step) * period / 2 < 20; ++step) {
    const double second = first + static_cast<double>(step) * period / 2;
    const auto add = [&](const std::vector<float>& sound, float decay) {
      const auto at = static_cast<size_t>(std::lround(second * kRate));
      for (size_t i = 0; i < sound.size() && at + i < wave.size(); ++i)
        wave[at + i] += sound[i] * std::exp(-decay * static_cast<float>(i) / kRate);
    };
    const char letter = steps[step % steps.size()];
    if (letter == 'k' || letter == 'b') add(kick, 25);
    if (letter == 'h') add(hat, 100);
    if (letter == 's' || letter == 'b') add(snare, 20);
  }
  return wave;
}

/// Plucked tones at 22 050 Hz, a broken chord whose three tones return every `period` seconds each.
inline std::vector<float> BrokenChord(double seconds, double period) {
  constexpr int64_t kRate = 22050;
  std::vector<float> wave(static_cast<size_t>(seconds * kRate));
  const std::vector<std::vector<float>> tones{Sine(220, kRate, kRate / 2, 0.2),
                                              Sine(277, kRate, kRate / 2, 0.2),
                                              Sine(330, kRate, kRate / 2, 0.2)};
  for (size_t nth = 0; static_cast<double>(nth) * period < seconds; ++nth) {
    const auto at = static_cast<size_t>(static_cast<double>(nth) * period * kRate);
    const std::vector<float>& tone = tones[nth % tones.size()];
    for (size_t i = 0; i < tone.size() && at + i < wave.size(); ++i)
      wave[at + i] += tone[i] * std::exp(-6 * static_cast<float>(i) / kRate);
  }
  return wave;
}

/// Chords and drums at 22 050 Hz, 20 s, from second 0.2 on. `chords` and `drums`, again and again:
/// a letter per beat: c chord, k bass drum, t tom, r rim, . nothing. Chords change every bar.
inline std::vector<float> ChordsAndDrums(double period, std::string_view chords,
                                         std::string_view drums) {
  constexpr int64_t kRate = 22050;
  std::vector<float> wave = Noise(20 * kRate, 9, 0.0001);
  for (size_t beat = 0; 0.2 + static_cast<double>(beat) * period < 20; ++beat) {
    const auto at = static_cast<size_t>((0.2 + static_cast<double>(beat) * period) * kRate);
    const auto add = [&](double hz, double level, double length, double decay) {
      for (size_t i = 0; i < static_cast<size_t>(length * kRate) && at + i < wave.size(); ++i) {
        const double t = static_cast<double>(i) / kRate;
        wave[at + i] += static_cast<float>(level * std::exp(-decay * t) *
                                           std::sin(2 * std::numbers::pi * hz * t));
      }
    };
    const double root = 110 * std::exp2(std::array{0, 5, 9, 7}[beat / 4 % 4] / 12.0);
    if (chords[beat % chords.size()] == 'c')
      for (const double over : {1.0, 1.26, 1.498, 2.0}) add(over * root, 0.07, period, 2);
    const char drum = drums[beat % drums.size()];
    if (drum == 'k') add(60, 0.5, 0.2, 30);
    if (drum == 't') add(180, 0.25, 0.2, 30);
    if (drum == 'r') add(1700, 0.2, 0.05, 80);
  }
  return wave;
}

}  // namespace choreo
