#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A performer's requests during the dance.
namespace choreo::live {

/// A library pose by name; an empty name takes back the last pose that can be.
struct Cue {
  std::string pose;
  std::optional<double> ahead_s = {};  ///< from now; none: the dance's default
};

/// Not thread-safe.
class Cues {
 public:
  virtual ~Cues() = default;
  /// The cues since the last call, oldest first. Does not block.
  virtual std::vector<Cue> Take() = 0;
};

/// Reads letters and digits from a terminal, without echo while it exists; backspace takes back.
/// Ignores arrows and function keys. `poses`: names for KeyboardKeys, in order; extra ones have no
/// key. Null if the file is not a terminal.
std::unique_ptr<Cues> ReadKeyboard(int terminal, std::vector<std::string> poses);
/// a-z, A-Z, 0-9.
const std::string& KeyboardKeys();

/// Receives OSC messages over UDP at `port` on all addresses of the machine: /choreo/key with a
/// pose's name and optionally the seconds ahead, a number of any type; /choreo/undo. Ignores other
/// messages and floods. Throws Error(kUnavailable), whose field is --osc, for a port in use.
std::unique_ptr<Cues> HearOsc(int port);

}  // namespace choreo::live
