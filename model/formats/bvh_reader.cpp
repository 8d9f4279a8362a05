#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/locale/encoding_utf.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/core/printable.h"
#include "model/formats/bvh.h"
#include "model/motion/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kMinFrameTime = 1e-5, kMaxFrameTime = 10;
constexpr double kMaxLength = 1000 * kMaxPosition;  // file units, which may be millimetres
constexpr double kMaxDegrees = kMaxWoundRotation * kDegrees;

// What Windows calls "Unicode": UTF-16, with a byte order mark or without.
std::string ToUtf8(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const bool little = text.size() > 1 && (text.starts_with("\xFF\xFE") || text[1] == '\0');
  const bool big = text.size() > 1 && (text.starts_with("\xFE\xFF") || text[0] == '\0');
  if (!little && !big) return std::string(text);
  std::u16string units;
  for (size_t i = 0; i + 1 < text.size(); i += 2) {
    const auto first = static_cast<unsigned char>(text[i]);
    const auto second = static_cast<unsigned char>(text[i + 1]);
    units += static_cast<char16_t>(little ? second << 8 | first : first << 8 | second);
  }
  if (units.starts_with(u'\uFEFF')) units.erase(0, 1);
  try {
    return boost::locale::conv::utf_to_utf<char>(units, boost::locale::conv::stop);
  } catch (const boost::locale::conv::conversion_error&) {
    throw InvalidArgument(name, "begins as UTF-16 does, and is none");
  }
}

// White space separates tokens; lines count for messages alone. What begins with # or // is a
// comment up to the end of its line.
class Tokens {
 public:
  Tokens(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool AtEnd() {
    SkipSpace();
    return at_ == text_.size();
  }

  std::string_view Next(const char* expected) {
    SkipSpace();
    if (at_ == text_.size()) Fail(expected, "the end of the file");
    const size_t begin = at_;
    while (at_ < text_.size() && !IsSpace(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  // "Frames:", "Frames :", or without the colon; what follows may stand right behind it.
  void Label(std::string_view word) {
    SkipSpace();
    if (!SameWord(text_.substr(at_, word.size()), word)) {
      const std::string expected = "'" + std::string(word) + ":'";
      Fail(expected, Next(expected.c_str()));
    }
    at_ += word.size();
    size_t colon = at_;
    while (colon < text_.size() && (text_[colon] == ' ' || text_[colon] == '\t')) ++colon;
    if (colon < text_.size() && text_[colon] == ':') at_ = colon + 1;
  }

  bool NextIs(char letter) {
    SkipSpace();
    return at_ < text_.size() && text_[at_] == letter;
  }

  // The rest of this line, for joint names with spaces in them.
  std::string_view RestOfLine(const char* expected) {
    while (at_ < text_.size() && IsSpace(text_[at_]) && text_[at_] != '\n') ++at_;
    const size_t begin = at_;
    // "ROOT Hips {" puts the brace on the same line.
    at_ = std::min(text_.find_first_of("\n{", begin), text_.size());
    size_t end = at_;
    while (end > begin && IsSpace(text_[end - 1])) --end;
    if (end == begin) Fail(expected, "nothing");
    return text_.substr(begin, end - begin);
  }

  void Expect(const char* word) {
    const std::string_view token = Next(word);
    if (!SameWord(token, word)) Fail("'" + std::string(word) + "'", token);
  }

  double Number(const char* expected, double limit = std::numeric_limits<double>::infinity()) {
    std::string_view token = Next(expected);
    std::string digits(token.starts_with('+') ? token.substr(1) : token);
    // As half of Europe writes it.
    if (std::ranges::count(digits, ',') == 1 && digits.find('.') == std::string::npos)
      std::ranges::replace(digits, ',', '.');
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size()) Fail(expected, token);
    if (error == std::errc::result_out_of_range) {
      if (digits.find("e-") == std::string::npos && digits.find("E-") == std::string::npos)
        Fail(expected, token);
      value = 0;  // below the smallest double
    } else if (error != std::errc() || !std::isfinite(value)) {
      Fail(std::string(expected) + " that is finite", token);
    }
    if (std::abs(value) > limit) {
      std::ostringstream within;
      within << expected << " from " << -limit << " to " << limit;
      Fail(within.str(), token);
    }
    return value;
  }

  int64_t line() const { return line_; }

  int64_t Count(const char* expected, int64_t limit) {
    const std::string_view token = Next(expected);
    int64_t value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc() || end != token.data() + token.size() || value < 0 || value > limit) {
      Fail(std::string(expected) + " of 0 to " + std::to_string(limit), token);
    }
    return value;
  }

  [[noreturn]] void Fail(const std::string& expected, std::string_view found) const {
    throw InvalidArgument(
        name_ + ":" + std::to_string(line_),
        "found '" + Printable(std::string(found.substr(0, 40))) + "', expected " + expected);
  }

  static bool SameWord(std::string_view a, std::string_view b) {
    return boost::algorithm::iequals(a, b, std::locale::classic());
  }

 private:
  static bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void SkipSpace() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#' || text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (IsSpace(text_[at_])) {
        line_ += text_[at_++] == '\n';
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  std::string name_;
  size_t at_ = 0;
  int64_t line_ = 1;
};

BvhChannel ReadChannel(Tokens& tokens, const std::vector<BvhChannel>& earlier) {
  const std::string_view token = tokens.Next("a channel");
  const auto* found = std::ranges::find_if(
      kBvhChannelNames, [&](std::string_view name) { return Tokens::SameWord(name, token); });
  if (found == std::end(kBvhChannelNames))
    tokens.Fail("a channel such as Xposition or Zrotation", token);
  const auto channel = static_cast<BvhChannel>(found - kBvhChannelNames);
  if (std::count(earlier.begin(), earlier.end(), channel) > 0) {
    tokens.Fail("a channel that this joint does not have already", token);
  }
  return channel;
}

std::vector<BvhJoint> ReadHierarchy(Tokens& tokens) {
  tokens.Expect("HIERARCHY");
  tokens.Expect("ROOT");
  std::vector<BvhJoint> joints;
  std::vector<int> open;  // joints whose closing brace is still to come
  const auto begin = [&](const std::string& name, bool end_site) {
    BvhJoint& joint = joints.emplace_back();
    joint.name = name;
    joint.parent = open.empty() ? -1 : open.back();
    joint.end_site = end_site;
    open.push_back(static_cast<int>(joints.size()) - 1);
    tokens.Expect("{");
    tokens.Expect("OFFSET");
    for (double& coordinate : joint.offset) coordinate = tokens.Number("a number", kMaxLength);
  };
  begin(std::string(tokens.RestOfLine("a joint name")), false);
  while (!open.empty()) {
    const std::string_view word = tokens.Next("'}'");
    if (word == "}") {
      open.pop_back();
    } else if (joints[open.back()].end_site) {
      tokens.Fail("'}'", word);
    } else if (Tokens::SameWord(word, "CHANNELS")) {
      std::vector<BvhChannel>& channels = joints[open.back()].channels;
      if (!channels.empty()) tokens.Fail("a joint or '}'", word);
      const int64_t count = tokens.Count("a number of channels", 9);
      for (int64_t i = 0; i < count; ++i) channels.push_back(ReadChannel(tokens, channels));
    } else if (Tokens::SameWord(word, "JOINT")) {
      begin(std::string(tokens.RestOfLine("a joint name")), false);
    } else if (Tokens::SameWord(word, "End") || Tokens::SameWord(word, "EndSite")) {
      if (Tokens::SameWord(word, "End")) tokens.Expect("Site");
      if (!tokens.NextIs('{')) tokens.RestOfLine("'{'");  // some give it a name
      begin(joints[open.back()].name + "_end", true);
    } else {
      tokens.Fail("CHANNELS, JOINT, End Site or '}'", word);
    }
  }
  return joints;
}

// Joints with six channels of which three are 0 throughout, or tell of small changes, would all
// stand in their parents' places.
void FindAdding(BvhFile& file) {
  constexpr double kNearly = 0.25;  // of the offset
  Eigen::Index row = 0;
  int adding = 0;
  for (BvhJoint& joint : file.joints) {
    double farthest = 0;
    bool has_positions = false;
    for (const BvhChannel channel : joint.channels) {
      if (channel <= BvhChannel::kZPosition && file.frames() > 0) {
        has_positions = true;
        farthest = std::max(farthest, file.values.row(row).cwiseAbs().maxCoeff());
      }
      ++row;
    }
    joint.adds = has_positions && joint.parent >= 0 && !joint.offset.isZero() &&
                 farthest < kNearly * joint.offset.norm();
    adding += joint.adds ? 1 : 0;
  }
  if (adding > 0) {
    file.notes.push_back("the places of " + std::to_string(adding) +
                         " joints are 0 or nearly so in all frames; their offsets are taken");
  }
}

}  // namespace

BvhFile ParseBvh(std::string_view text, const std::string& name) {
  const std::string utf8 = ToUtf8(text, name);
  Tokens tokens(utf8, name);
  BvhFile file;
  file.joints = ReadHierarchy(tokens);
  std::vector<bool> is_position;  // of each channel
  for (const BvhJoint& joint : file.joints) {
    for (const BvhChannel channel : joint.channels)
      is_position.push_back(channel <= BvhChannel::kZPosition);
  }
  const int64_t channels = std::ssize(is_position);
  if (channels == 0) tokens.Fail("a joint with channels", "a hierarchy without any");

  tokens.Expect("MOTION");
  tokens.Label("Frames");
  const int64_t stated = tokens.Count("a number of frames", int64_t{1} << 32);
  tokens.Label("Frame");
  tokens.Label("Time");
  file.frame_time = tokens.Number("a frame time");
  file.states_rate = file.frame_time != 0;
  if (!file.states_rate) file.frame_time = 1 / kModelFps;
  if (!(file.frame_time >= kMinFrameTime && file.frame_time <= kMaxFrameTime)) {
    tokens.Fail("a frame time of 1e-5 to 10 s", std::to_string(file.frame_time));
  }
  std::vector<double> values;  // grown as they come: the header's count may be anything
  // A row that is complete counts, whatever the header says.
  int64_t lines = 0, line = -1;
  while (!tokens.AtEnd()) {
    if (std::exchange(line, tokens.line()) != tokens.line()) ++lines;
    const size_t channel = values.size() % static_cast<size_t>(channels);
    values.push_back(is_position[channel] ? tokens.Number("a number", kMaxLength)
                                          : tokens.Number("a number of degrees", kMaxDegrees));
  }
  const int64_t frames = std::ssize(values) / channels;
  // The last number of a file that was cut off may be cut off, too.
  const bool cut = frames < stated && (frames == 0 || !utf8.ends_with('\n'));
  const bool other_rows = frames != stated && lines == stated;
  if (std::ssize(values) % channels != 0 || cut || other_rows) {
    tokens.Fail(std::to_string(std::max(frames, stated)) + " frames of " +
                    std::to_string(channels) + " values, as the header says; there are " +
                    std::to_string(values.size()) + " values",
                "the end of the file");
  }
  if (frames != stated) {
    file.notes.push_back("its header says " + std::to_string(stated) + " frames; all " +
                         std::to_string(frames) + " that are there are read");
  }
  file.values = Eigen::Map<const Eigen::MatrixXd>(values.data(), channels, frames);
  FindAdding(file);
  return file;
}

BvhFile ReadBvh(const std::filesystem::path& path) {
  return ParseBvh(ReadFile(path), path.string());
}

}  // namespace choreo
