#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace choreo {

/// The rate, in Hz, of everything behind the resampler: mono samples, mel spectra, rows, beats.
inline constexpr int kModelSampleRate = 22050;

// What is accepted as audio, from files and from streams alike.
inline constexpr int kMinSampleRate = 8000;    ///< Hz
inline constexpr int kMaxSampleRate = 192000;  ///< Hz
inline constexpr int kMaxChannels = 8;
inline constexpr int kMaxAudioSeconds = 600;
/// Beats that may be told with a song: 20 a second.
inline constexpr size_t kMostBeats = size_t{20} * kMaxAudioSeconds;
inline constexpr size_t kMostPassages = 6000;  ///< that may be told to come back: ten a second
/// Of all channels of a file together: ten minutes of 192 kHz in stereo, or of 48 kHz in 8
/// channels.
inline constexpr int64_t kMaxFileSamples = 240'000'000;

/// Throws Error(kInvalidArgument) unless `sample_rate` is a whole number of Hz, and it and
/// `channels` are within the limits above. The fields are `name`.sample_rate and `name`.channels.
void CheckAudioFormat(double sample_rate, int channels, const std::string& name = "audio");

/// Throws Error(kInvalidArgument) where an interleaved sample is NaN or infinite. `first_sample` is
/// the absolute index (one a channel set) of the first of them; the message names that of the
/// offender.
void CheckFinite(std::span<const float> interleaved, int channels, int64_t first_sample,
                 const std::string& name = "audio");

}  // namespace choreo
