#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace choreo {

/// The rate, in Hz, of everything after the resampler: mono samples, mel spectra, rows, beats.
inline constexpr int kModelSampleRate = 22050;

// Limits of audio in files and streams.
inline constexpr int kMinSampleRate = 8000;    ///< Hz
inline constexpr int kMaxSampleRate = 192000;  ///< Hz
inline constexpr int kMaxChannels = 8;
inline constexpr int kMaxAudioSeconds = 600;
/// The largest number of beats with a song: 20 a second.
inline constexpr size_t kMaxBeats = size_t{20} * kMaxAudioSeconds;
inline constexpr size_t kMaxPassages =
    6000;  ///< the largest number of repeats with a song: ten a second
/// The largest number of energies with a song, two a second, and the largest energy.
inline constexpr size_t kMaxEnergies = size_t{2} * kMaxAudioSeconds;
inline constexpr float kMaxEnergy = 2;
/// The largest number of samples in a file, all channels together: ten minutes at 192 kHz in
/// stereo, or at 48 kHz in 8 channels.
inline constexpr int64_t kMaxFileSamples = 240'000'000;

/// Throws Error(kInvalidArgument) unless `sample_rate` is a whole number of Hz, and it and
/// `channels` are within the limits above. The fields are `name`.sample_rate and `name`.channels.
void CheckAudioFormat(double sample_rate, int channels, const std::string& name = "audio");

/// Throws Error(kInvalidArgument, FIELD[i]) unless beats, in seconds, ascend strictly within the
/// longest music; Error(kInvalidArgument, FIELD) for more than kMaxBeats.
void CheckBeats(std::span<const double> beats, const std::string& field);
/// CheckBeats for downbeats, each of which must also be one of `beats`. `beats` must have passed
/// CheckBeats.
void CheckDownbeats(std::span<const double> downbeats, std::span<const double> beats,
                    const std::string& field);

/// Throws Error(kInvalidArgument, FIELD[i]) unless energies are within kMaxEnergy;
/// Error(kInvalidArgument, FIELD) for more than kMaxEnergies.
void CheckEnergies(std::span<const float> energies, const std::string& field);

/// The largest sample: 40 dB above full scale, more than any mix has. Floats that are scaled like
/// 16-bit integers exceed it.
inline constexpr float kMaxLevel = 100;
/// The smallest audible sample: a step of 16-bit integers.
inline constexpr float kMinLevel = 1.0F / 32768;

/// Throws Error(kInvalidArgument, NAME) if an interleaved sample is NaN, infinite or beyond
/// kMaxLevel; the message names its index. `first_sample` is the absolute index of the first sample
/// (one per set of channels).
void CheckLevels(std::span<const float> interleaved, int channels, int64_t first_sample,
                 const std::string& name = "audio");

}  // namespace choreo
