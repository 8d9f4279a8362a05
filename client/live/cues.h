#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Cues: a performer's requests during a live dance.
namespace choreo::live {

/// A request for a library pose, by name. An empty name takes back the latest pose that still can
/// be.
struct Cue {
  std::string pose;
  std::optional<double> ahead_s = {};  ///< seconds from now; none: the dance's default
};

/// A source of cues. Not thread-safe.
class Cues {
 public:
  virtual ~Cues() = default;
  /// Returns the cues since the last call, oldest first. Does not block.
  virtual std::vector<Cue> Take() = 0;
};

/// Reads letters and digits from a terminal, whose echo is off while the returned object exists.
/// Backspace takes back a pose. Ignores arrows and function keys. `poses`: names for KeyboardKeys,
/// in order; extra ones have no key. Returns null if the file is not a terminal.
std::unique_ptr<Cues> ReadKeyboard(int terminal, std::vector<std::string> poses);
/// The keys that ReadKeyboard assigns to poses: a-z, A-Z, 0-9.
const std::string& KeyboardKeys();

/// Receives OSC messages over UDP at `port` on all addresses of the machine: /choreo/key with a
/// pose's name and optionally the seconds ahead (a number of any type), and /choreo/undo. Ignores
/// other messages and floods. Throws Error(kUnavailable), whose field is --osc, for a port in use.
std::unique_ptr<Cues> HearOsc(int port);

}  // namespace choreo::live
