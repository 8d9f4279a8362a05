#include <iconv.h>

#include <algorithm>
#include <boost/locale/encoding_utf.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/formats/bvh/bvh.h"
#include "model/formats/bvh/bvh_tokens.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kMinFrameTime = 1e-5, kMaxFrameTime = 4;
constexpr double kMaxLength = 1000 * kMaxPosition;  // file units, which may be millimetres
constexpr double kMaxDegrees = kMaxWoundRotation * kDegrees;

std::optional<std::string> FromCodePage(const char* page, std::string text) {
  const iconv_t converter = iconv_open("UTF-8", page);
  // NOLINTNEXTLINE: the way iconv says so
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string utf8(3 * text.size(), '\0');
  char *from = text.data(), *to = utf8.data();
  size_t left = text.size(), room = utf8.size();
  const bool whole = iconv(converter, &from, &left, &to, &room) != static_cast<size_t>(-1);
  iconv_close(converter);
  utf8.resize(utf8.size() - room);
  return whole ? std::optional(std::move(utf8)) : std::nullopt;
}

// Names may be in Windows's Japanese or Western encoding.
std::string FromAnyBytes(std::string text) {
  for (const char* page : {"UTF-8", "CP932", "ISO-8859-1"})
    if (auto utf8 = FromCodePage(page, text)) return *std::move(utf8);
  return text;
}

// Converts UTF-16, which Windows calls "Unicode", with or without a byte order mark.
std::string ToUtf8(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const bool little = text.size() > 1 && (text.starts_with("\xFF\xFE") || text[1] == '\0');
  const bool big = text.size() > 1 && (text.starts_with("\xFE\xFF") || text[0] == '\0');
  if (!little && !big) return FromAnyBytes(std::string(text));
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

BvhChannel ReadChannel(BvhTokens& tokens, const std::vector<BvhChannel>& earlier) {
  const std::string_view token = tokens.Next("a channel");
  const auto* found = std::ranges::find_if(
      kBvhChannelNames, [&](std::string_view name) { return BvhTokens::SameWord(name, token); });
  if (found == std::end(kBvhChannelNames))
    tokens.Fail("a channel such as Xposition or Zrotation", token);
  const auto channel = static_cast<BvhChannel>(found - kBvhChannelNames);
  if (std::count(earlier.begin(), earlier.end(), channel) > 0) {
    tokens.Fail("a channel that this joint does not have already", token);
  }
  return channel;
}

std::vector<BvhJoint> ReadHierarchy(BvhTokens& tokens) {
  tokens.Expect("HIERARCHY");
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
  const auto begin_root = [&] {
    tokens.Expect("ROOT");
    begin(std::string(tokens.RestOfLine("a joint name")), false);
  };
  begin_root();
  while (!open.empty() || tokens.NextIs("ROOT")) {
    if (open.empty()) begin_root();  // a root of another person or a prop
    const std::string_view word = tokens.Next("'}'");
    if (word == "}") {
      open.pop_back();
    } else if (joints[open.back()].end_site) {
      tokens.Fail("'}'", word);
    } else if (BvhTokens::SameWord(word, "CHANNELS")) {
      std::vector<BvhChannel>& channels = joints[open.back()].channels;
      if (!channels.empty()) tokens.Fail("a joint or '}'", word);
      const int64_t count = tokens.Count("a number of channels", 9);
      for (int64_t i = 0; i < count; ++i) channels.push_back(ReadChannel(tokens, channels));
    } else if (BvhTokens::SameWord(word, "JOINT")) {
      begin(std::string(tokens.RestOfLine("a joint name")), false);
    } else if (BvhTokens::SameWord(word, "End") || BvhTokens::SameWord(word, "EndSite")) {
      if (BvhTokens::SameWord(word, "End")) tokens.Expect("Site");
      if (!tokens.NextIs('{')) tokens.RestOfLine("'{'");  // some files name the End Site
      begin(joints[open.back()].name + "_end", true);
    } else {
      tokens.Fail("CHANNELS, JOINT, End Site or '}'", word);
    }
  }
  return joints;
}

// Joints whose position channels are 0 or small throughout would coincide with their parents. Such
// channels are added to the offset.
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
                         " joints are 0 or nearly so in all frames; their offsets are used");
  }
}

}  // namespace

BvhFile ParseBvh(std::string_view text, const std::string& name) {
  const std::string utf8 = ToUtf8(text, name);
  BvhTokens tokens(utf8, name);
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
  // Some programs write milliseconds: 4 and more mean at most 250 frames per second.
  if (const double seconds = file.frame_time / 1000;
      file.frame_time >= kMaxFrameTime && seconds < 1) {
    file.notes.push_back("its frame time is " + Rounded(file.frame_time) +
                         ", which is read as milliseconds");
    file.frame_time = seconds;
  }
  if (!(file.frame_time >= kMinFrameTime && file.frame_time <= kMaxFrameTime)) {
    tokens.Fail("a frame time of 1e-5 to 4 s, or as many milliseconds",
                std::to_string(file.frame_time));
  }
  std::vector<double> values;  // not reserved, because the header's count may be wrong
  // Complete rows count, whatever the header says.
  int64_t lines = 0, line = -1;
  while (!tokens.AtEnd()) {
    if (std::exchange(line, tokens.line()) != tokens.line()) ++lines;
    const size_t channel = values.size() % static_cast<size_t>(channels);
    values.push_back(is_position[channel] ? tokens.Number("a number", kMaxLength)
                                          : tokens.Number("a number of degrees", kMaxDegrees));
  }
  const int64_t frames = std::ssize(values) / channels;
  // In a truncated file the last number may be truncated, too.
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
