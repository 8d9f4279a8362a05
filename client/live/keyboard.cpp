#include <termios.h>
#include <unistd.h>

#include <utility>

#include "client/live/cues.h"

namespace choreo::live {
namespace {

class Keyboard final : public Cues {
 public:
  Keyboard(int terminal, const termios& before, std::vector<std::string> poses)
      : terminal_(terminal), before_(before), poses_(std::move(poses)) {
    // Makes input unbuffered and non-blocking; Ctrl-C still works.
    termios now = before;
    now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    now.c_cc[VMIN] = 0;
    now.c_cc[VTIME] = 0;
    tcsetattr(terminal_, TCSANOW, &now);
  }
  ~Keyboard() override { tcsetattr(terminal_, TCSANOW, &before_); }

  std::vector<Cue> Take() override {
    constexpr char kBackspace = 0x7f, kControlH = 0x08;
    std::vector<Cue> cues;
    bool typed = false;
    for (char key = 0; read(terminal_, &key, 1) == 1; typed = true) {
      if (IsOfSequence(key)) continue;
      const size_t at = KeyboardKeys().find(key);
      if (key == kBackspace || key == kControlH)
        cues.push_back({});
      else if (at < poses_.size())
        cues.push_back({poses_[at]});
    }
    // Escape was pressed alone: later bytes are not part of a sequence.
    if (!typed) sequence_ = Sequence::kNone;
    return cues;
  }

 private:
  enum class Sequence { kNone, kEscape, kOneMore, kParameters };

  // Arrows, function keys, and letters with Alt are several bytes that begin with Escape (ECMA-48).
  bool IsOfSequence(char key) {
    constexpr char kEscape = 0x1b;
    const Sequence before = std::exchange(sequence_, Sequence::kNone);
    if (key == kEscape) {
      sequence_ = Sequence::kEscape;
    } else if (before == Sequence::kEscape && key == '[') {
      sequence_ = Sequence::kParameters;
    } else if (before == Sequence::kEscape && key == 'O') {
      sequence_ = Sequence::kOneMore;
    } else if (before == Sequence::kParameters && (key < '@' || key > '~')) {
      sequence_ = Sequence::kParameters;
    }
    return key == kEscape || before != Sequence::kNone;
  }

  int terminal_;
  termios before_;
  std::vector<std::string> poses_;
  Sequence sequence_ = Sequence::kNone;
};

}  // namespace

std::unique_ptr<Cues> ReadKeyboard(int terminal, std::vector<std::string> poses) {
  termios before{};
  if (tcgetattr(terminal, &before) != 0) return nullptr;
  return std::make_unique<Keyboard>(terminal, before, std::move(poses));
}

const std::string& KeyboardKeys() {
  static const std::string kKeys = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  return kKeys;
}

}  // namespace choreo::live
