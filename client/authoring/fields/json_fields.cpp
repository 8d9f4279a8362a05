#include "client/authoring/fields/json_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "model/core/error.h"
#include "model/core/files/json_limits.h"
#include "model/core/hit.h"
#include "model/core/rounded.h"

namespace choreo::authoring {

using nlohmann::json;

namespace {

constexpr size_t kMaxShownLength = 40;  // characters of a value

/// The position of the parser in a text.
class Place {
 public:
  explicit Place(const std::string& name) : name_(name) {}

  /// Follows the parser to its next event. Throws Error(kInvalidArgument) for a duplicate member.
  void Follow(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        levels_.emplace_back().is_list = event == json::parse_event_t::array_start;
        return;
      case json::parse_event_t::key:
        levels_.back().member = parsed.get<std::string>();
        if (!levels_.back().seen.insert(levels_.back().member).second)
          throw InvalidArgument(Text(), "is there twice");
        return;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        levels_.pop_back();
        break;
      case json::parse_event_t::value:
        break;
    }
    if (!levels_.empty()) ++levels_.back().index;
  }

  std::string Text() const {
    std::string text = name_;
    for (const Level& level : levels_) {
      if (level.is_list) {
        text += "[" + std::to_string(level.index) + "]";
      } else if (!level.member.empty()) {
        text += (&level == &levels_.front() ? ":" : ".") + level.member;
      }
    }
    return text;
  }

 private:
  struct Level {
    bool is_list = false;
    size_t index = 0;    // of a list's entry
    std::string member;  // of an object
    std::set<std::string> seen;
  };
  const std::string& name_;
  std::vector<Level> levels_;
};

/// Describes the line and column of the `byte`th character of a text, counted from 1.
std::string At(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, byte == 0 ? 0 : byte - 1);
  const size_t line = before.rfind('\n');
  return "line " + std::to_string(std::ranges::count(before, '\n') + 1) + ", column " +
         std::to_string(before.size() - (line == std::string_view::npos ? 0 : line + 1) + 1);
}

/// The word around the `byte`th character of a text, such as NaN; empty if there is none.
std::string WordAt(std::string_view text, size_t byte) {
  if (byte == 0 || byte > text.size()) return "";
  const auto is_other = [](unsigned char c) { return std::isalnum(c) == 0; };
  const auto at = text.begin() + static_cast<std::ptrdiff_t>(byte - 1);
  const auto end = std::find_if(at, text.end(), is_other);
  const auto begin = std::find_if(std::reverse_iterator(at), text.rend(), is_other).base();
  if (at == end) return "";
  return ", \"" + std::string(begin, end).substr(0, kMaxShownLength) + '"';
}

/// Describes what is wrong with a text at its `byte`th character, the last one read, and where it
/// is.
std::string DescribeBreak(std::string_view text, size_t byte) {
  if (byte > 0 && byte <= text.size() && (text[byte - 1] == '}' || text[byte - 1] == ']')) {
    const size_t before = text.substr(0, byte - 1).find_last_not_of(" \t\r\n");
    if (before != std::string_view::npos && text[before] == ',')
      return "has an extra comma at " + At(text, before + 1);
  }
  return (byte > text.size() ? "ends too early at " : "cannot be read at ") + At(text, byte) +
         WordAt(text, byte);
}

void RefuseOthers(const json& object, const std::string& prefix,
                  std::initializer_list<std::string_view> members, const std::string& described) {
  for (const auto& [member, ignored] : object.items()) {
    if (std::find(members.begin(), members.end(), member) == members.end())
      throw InvalidArgument(prefix + member, "is not known; " + described);
  }
}

}  // namespace

std::string Shown(const json& value) {
  std::string text = value.dump();
  if (text.size() > kMaxShownLength) text = text.substr(0, kMaxShownLength - 3) + "...";
  return text;
}

double JsonNumber(const json& value, const std::string& field) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InvalidArgument(field, Shown(value) + " is not a number");
  return value.get<double>();
}

double JsonHit(const json& value, const std::string& field) {
  const double hit = JsonNumber(value, field);
  if (hit >= 0 && hit <= kMaxHit) return hit;
  throw InvalidArgument(field, Shown(value) + " is not a number from 0 (gently) to " +
                                   InFull(kMaxHit) + " (late and fast)");
}

HandPose JsonHands(const json& value, const std::string& field) {
  const auto found =
      value.is_string() ? FindHandPose(value.get<std::string>()) : std::optional<HandPose>();
  if (found) return *found;
  throw InvalidArgument(field, Shown(value) + " is none of " + HandPoseNames());
}

std::string ReadText(const std::filesystem::path& path, const std::string& kind) {
  if (std::filesystem::is_directory(path)) {
    throw InvalidArgument(path.string(), "is a folder, not a " + kind);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  std::string text;
  std::array<char, 1 << 16> piece;
  do {
    file.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<size_t>(file.gcount()));
    if (text.size() > kMaxTextBytes) {
      throw InvalidArgument(path.string(),
                            "is larger than " + std::to_string(kMaxTextBytes >> 20) + " MiB");
    }
  } while (file);
  return text;
}

json ParseJson(std::string_view text, const std::string& name) {
  CheckJsonDepth(text, name);
  Place place(name);
  json root;
  try {
    root = json::parse(text, [&](int, json::parse_event_t event, const json& parsed) {
      place.Follow(event, parsed);
      return true;
    });
  } catch (const json::parse_error& error) {
    throw InvalidArgument(place.Text(), "is not JSON: " + DescribeBreak(text, error.byte));
  } catch (const json::exception& error) {  // "... number overflow parsing '1e999'"
    const std::string message = error.what();
    const size_t from = message.find('\''), to = message.rfind('\'');
    const std::string number = from < to ? message.substr(from + 1, to - from - 1) : "a number";
    throw InvalidArgument(place.Text(), number + " is beyond 1.8e308, the largest number");
  }
  return root;
}

const json& ListIn(const json& file, const std::string& name, const std::string& list) {
  if (!file.is_object() || !file.contains(list) || !file[list].is_array())
    throw InvalidArgument(name, "has no list \"" + list + '"');
  if (file[list].empty()) throw InvalidArgument(name + ":" + list, "is empty");
  return file[list];
}

void CheckMembers(const json& value, const std::string& field,
                  std::initializer_list<std::string_view> members, const std::string& described) {
  if (!value.is_object()) throw InvalidArgument(field, Shown(value) + " is not an object");
  RefuseOthers(value, field + ".", members, described);
}

void CheckFileMembers(const json& file, const std::string& name,
                      std::initializer_list<std::string_view> members,
                      const std::string& described) {
  if (file.is_object()) RefuseOthers(file, name + ":", members, described);
}

WrittenTime JsonTime(const json& value, const std::string& field) {
  if (value.is_string()) return ParseTime(value.get<std::string>(), field);
  return {.amount = JsonNumber(value, field)};
}

Moment ParseMoment(const json& value, const std::string& field, const Counts& counts) {
  if (value.contains("time") == value.contains("frame")) {
    throw InvalidArgument(field + ".time", value.contains("time") ? "cannot be combined with frame"
                                                                  : "is missing, and so is frame");
  }
  Moment moment;
  if (value.contains("frame")) {
    if (!IsFrameNumber(value["frame"])) {
      throw InvalidArgument(field + ".frame", Shown(value["frame"]) +
                                                  " is not a whole number from 0 to " +
                                                  std::to_string(kMaxFrameNumber));
    }
    moment.frame = value["frame"].get<int64_t>();
    return moment;
  }
  moment.time_s = JsonTime(value["time"], field + ".time").In(counts, field + ".time");
  if (!(moment.time_s >= 0))
    throw InvalidArgument(field + ".time", Shown(value["time"]) + " s is before 0");
  if (moment.time_s > kMaxSeconds)
    throw InvalidArgument(field + ".time",
                          Shown(value["time"]) + " s is beyond " + InFull(kMaxSeconds) + " s");
  return moment;
}

void CheckInADance(double seconds, const std::string& field) {
  if (seconds <= kMaxDanceSeconds) return;
  std::ostringstream message;
  message << seconds << " s is beyond " << kMaxDanceSeconds << " s, the longest dance";
  throw InvalidArgument(field, message.str());
}

void AppendFrame(const json& value, const std::string& field, double fps, const Counts& counts,
                 std::vector<int64_t>* frames) {
  const Moment moment = ParseMoment(value, field, counts);
  const int64_t frame = moment.frame.value_or(std::llround(moment.time_s * fps));
  const std::string when = field + (moment.frame ? ".frame" : ".time");
  const double seconds = static_cast<double>(frame) / fps;
  CheckInADance(seconds, when);
  if (!frames->empty() && frame == frames->back()) {
    std::ostringstream message;
    message << "is frame " << frame
            << ", as that of the point before it; there may be one a frame, " << fps << " a second";
    throw InvalidArgument(when, message.str());
  }
  if (!frames->empty() && frame < frames->back()) {
    throw InvalidArgument(when, "is frame " + std::to_string(frame) +
                                    ", not after that of the point before it, " +
                                    std::to_string(frames->back()));
  }
  frames->push_back(frame);
}

}  // namespace choreo::authoring
