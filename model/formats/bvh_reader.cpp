#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/formats/bvh.h"
#include "model/motion/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kMinFrameTime = 1e-5, kMaxFrameTime = 10;
constexpr double kMaxLength = 1000 * kMaxPosition;  // file units, which may be millimetres
constexpr double kMaxDegrees = kMaxWoundRotation * kDegrees;

// White space separates tokens; lines count for messages alone.
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
    const std::string_view digits = token.starts_with('+') ? token.substr(1) : token;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size()) Fail(expected, token);
    if (error == std::errc::result_out_of_range) {
      if (digits.find("e-") == std::string_view::npos &&
          digits.find("E-") == std::string_view::npos)
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
    throw InvalidArgument(name_ + ":" + std::to_string(line_),
                          "found '" + std::string(found.substr(0, 40)) + "', expected " + expected);
  }

  static bool SameWord(std::string_view a, std::string_view b) {
    return boost::algorithm::iequals(a, b, std::locale::classic());
  }

 private:
  static bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void SkipSpace() {
    for (; at_ < text_.size() && IsSpace(text_[at_]); ++at_) line_ += text_[at_] == '\n';
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
      const int64_t count = tokens.Count("a number of channels", 6);
      for (int64_t i = 0; i < count; ++i) channels.push_back(ReadChannel(tokens, channels));
    } else if (Tokens::SameWord(word, "JOINT")) {
      begin(std::string(tokens.RestOfLine("a joint name")), false);
    } else if (Tokens::SameWord(word, "End")) {
      tokens.Expect("Site");
      begin(joints[open.back()].name + "_end", true);
    } else {
      tokens.Fail("CHANNELS, JOINT, End Site or '}'", word);
    }
  }
  return joints;
}

}  // namespace

BvhFile ParseBvh(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  Tokens tokens(text, name);
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
  tokens.Expect("Frames:");
  const int64_t frames = tokens.Count("a number of frames", int64_t{1} << 32);
  tokens.Expect("Frame");
  tokens.Expect("Time:");
  file.frame_time = tokens.Number("a frame time");
  if (!(file.frame_time >= kMinFrameTime && file.frame_time <= kMaxFrameTime)) {
    tokens.Fail("a frame time of 1e-5 to 10 s", std::to_string(file.frame_time));
  }
  std::vector<double> values;  // grown as they come: the header's count may be anything
  for (int64_t i = 0; i < frames * channels; ++i) {
    values.push_back(is_position[static_cast<size_t>(i % channels)]
                         ? tokens.Number("a number", kMaxLength)
                         : tokens.Number("a number of degrees", kMaxDegrees));
  }
  if (!tokens.AtEnd()) {
    tokens.Fail("the end of the file after " + std::to_string(frames) + " frames of " +
                    std::to_string(channels) + " values",
                tokens.Next(""));
  }
  file.values = Eigen::Map<const Eigen::MatrixXd>(values.data(), channels, frames);
  return file;
}

BvhFile ReadBvh(const std::filesystem::path& path) {
  return ParseBvh(ReadFile(path), path.string());
}

}  // namespace choreo
