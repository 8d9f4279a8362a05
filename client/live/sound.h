#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>

/// Live music.
namespace choreo::live {

/// The longest piece of sound, seconds.
inline constexpr double kPieceSeconds = 0.02;

/// Not thread-safe.
class Sound {
 public:
  virtual ~Sound() = default;
  virtual int sample_rate() const = 0;  ///< Hz
  virtual int channels() const = 0;
  /// Its length; infinity if it lasts until stopped.
  virtual double seconds() const { return std::numeric_limits<double>::infinity(); }
  /// The next interleaved samples; blocks until they have sounded. Valid until the next call. Empty
  /// at the end. Throws Error(kUnavailable) if the device is lost.
  virtual std::span<const float> Next() = 0;
};

/// Plays a file silently from second `start` on: samples come at the speed of sound. Fails like
/// DecodeAudioFile, and kInvalidArgument (--song-start) for a start after its end.
std::unique_ptr<Sound> PlaySong(const std::filesystem::path& path, double start = 0);

/// A microphone or line in, mono: an ALSA capture device by name; "default" is the desktop's (also
/// with PipeWire and PulseAudio). Throws Error(kNotFound), whose field is --input, if it cannot be
/// opened.
std::unique_ptr<Sound> ListenTo(const std::string& device);

}  // namespace choreo::live
