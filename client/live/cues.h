#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What a performer asks for while the dance goes on.
namespace choreo::live {

/// A pose, by its name in the library; without a name, the last one that can be taken back.
struct Cue {
  std::string pose;
  std::optional<double> ahead_s = {};  ///< from now; none: as the dance was told
};

/// Not thread-safe.
class Cues {
 public:
  virtual ~Cues() = default;
  /// Those since the last call, oldest first. Does not block.
  virtual std::vector<Cue> Take() = 0;
};

/// Letters and digits typed at a terminal, which shows none of them as long as this lives; the
/// backspace key takes back. Arrows and function keys do nothing. `poses`: names, of the keys of
/// KeyboardKeys in their order; those beyond have no key. Null where the file is no terminal.
std::unique_ptr<Cues> ReadKeyboard(int terminal, std::vector<std::string> poses);
/// a-z, A-Z, 0-9.
const std::string& KeyboardKeys();

/// OSC messages, over UDP at `port` of all of the machine's addresses: /choreo/key with a pose's
/// name and, if so, the seconds ahead, a number of any type; /choreo/undo. Others are left aside,
/// and so is what comes in floods. Throws Error(kUnavailable), whose field is --osc, for a port
/// that is taken.
std::unique_ptr<Cues> HearOsc(int port);

}  // namespace choreo::live
