#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>

/// Music while it sounds.
namespace choreo::live {

/// At most so much of it comes at a time, seconds.
inline constexpr double kPieceSeconds = 0.02;

/// Not thread-safe.
class Sound {
 public:
  virtual ~Sound() = default;
  virtual int sample_rate() const = 0;  ///< Hz
  virtual int channels() const = 0;
  /// How long it lasts; infinity: until somebody ends it.
  virtual double seconds() const { return std::numeric_limits<double>::infinity(); }
  /// The next interleaved samples, once they have sounded; blocks until then. Valid until the next
  /// call. None: it is over. Throws Error(kUnavailable) for a device that is lost.
  virtual std::span<const float> Next() = 0;
};

/// A file from its second `start` on, as if it were played now: nothing is heard, but samples come
/// as fast as they sound. Errors as DecodeAudioFile, and kInvalidArgument (--song-start) for a
/// start behind its end.
std::unique_ptr<Sound> PlaySong(const std::filesystem::path& path, double start = 0);

/// A microphone or line in, mono: a capture device by its name in ALSA, "default" for that of the
/// desktop (PipeWire's and PulseAudio's, too). Throws Error(kNotFound), whose field is --input,
/// where it cannot be opened.
std::unique_ptr<Sound> ListenTo(const std::string& device);

}  // namespace choreo::live
