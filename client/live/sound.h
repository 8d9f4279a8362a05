#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>

#include "model/audio/decode/decode.h"

/// Sources of live music.
namespace choreo::live {

/// The longest piece of sound, seconds.
inline constexpr double kPieceSeconds = 0.02;

/// A source of live music. Not thread-safe.
class Sound {
 public:
  virtual ~Sound() = default;
  virtual int sample_rate() const = 0;  ///< Hz
  virtual int channels() const = 0;
  /// The music's length, seconds; infinity if it lasts until stopped.
  virtual double seconds() const { return std::numeric_limits<double>::infinity(); }
  /// Returns the next interleaved samples, after waiting until they have sounded. They are valid
  /// until the next call, and empty at the end. Throws Error(kUnavailable) if the device is lost.
  virtual std::span<const float> Next() = 0;
};

/// Plays a song silently: samples arrive at the speed at which they would be heard.
std::unique_ptr<Sound> PlaySong(DecodedAudio song);

/// Records from a microphone or line in, mono. `device`: the name of an ALSA capture device;
/// "default" is the desktop's (also with PipeWire and PulseAudio). Throws Error(kNotFound), whose
/// field is --input, if it cannot be opened.
std::unique_ptr<Sound> ListenTo(const std::string& device);

}  // namespace choreo::live
