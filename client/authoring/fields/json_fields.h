#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "model/core/hand_pose.h"
#include "model/core/limits.h"

/// Helpers for reading JSON files that people write (key files, path files). Errors are
/// Error(kInvalidArgument) whose field is NAME:LIST[i].MEMBER, naming value and limit.
namespace choreo::authoring {

/// The largest frame number in a file: after the end of any dance.
inline constexpr uint64_t kMaxFrameNumber = 1'000'000'000;
/// Whether a JSON value is a frame number: an integer from 0 to kMaxFrameNumber.
template <typename Json>
bool IsFrameNumber(const Json& value) {
  return value.is_number_unsigned() && value.template get<uint64_t>() <= kMaxFrameNumber;
}
/// A time after the end of any dance, and far below the limits of frame numbers.
inline constexpr double kMaxSeconds = 1e9;
/// Seconds of the longest dance.
inline constexpr double kMaxDanceSeconds = kMaxDanceFrames / kModelFps;
/// Throws Error(kInvalidArgument, field) for more seconds than kMaxDanceSeconds.
void CheckInADance(double seconds, const std::string& field);

/// Formats a value for messages, in at most 40 characters.
std::string Shown(const nlohmann::json& value);

double JsonNumber(const nlohmann::json& value, const std::string& field);
/// Reads how hard a key is hit, 0 to kMaxHit.
double JsonHit(const nlohmann::json& value, const std::string& field);
/// Reads one of kHandPoseNames.
HandPose JsonHands(const nlohmann::json& value, const std::string& field);

/// Limit of a text file's size: more bytes than people write.
inline constexpr size_t kMaxTextBytes = size_t{64} << 20;

/// Reads a text file. Throws Error(kNotFound) if it cannot be opened, and Error(kInvalidArgument)
/// for a folder, and for more than kMaxTextBytes. `kind`: the expected kind of file, for messages,
/// such as "key file".
std::string ReadText(const std::filesystem::path& path, const std::string& kind);

/// Parses JSON. Refuses duplicate members. An error's field, NAME:LIST[i].MEMBER, is the last place
/// that could be read.
nlohmann::json ParseJson(std::string_view text, const std::string& name);

/// Finds the list called `list` in the outermost object of the file `name`. Throws if it is missing
/// or empty.
const nlohmann::json& ListIn(const nlohmann::json& file, const std::string& name,
                             const std::string& list);

/// Checks that the value is an object with only these members; `described` lists them in messages.
void CheckMembers(const nlohmann::json& value, const std::string& field,
                  std::initializer_list<std::string_view> members, const std::string& described);

/// Checks that the outermost value of the file `name` is an object with only these members;
/// `described` lists them in messages.
void CheckFileMembers(const nlohmann::json& file, const std::string& name,
                      std::initializer_list<std::string_view> members,
                      const std::string& described);

/// Reads a time from JSON: a number of seconds, or text for ParseTime.
WrittenTime JsonTime(const nlohmann::json& value, const std::string& field);

/// A moment in JSON: exactly one of the members `time`, in seconds or counts, and `frame`.
struct Moment {
  double time_s = 0;
  std::optional<int64_t> frame = {};
};
Moment ParseMoment(const nlohmann::json& value, const std::string& field,
                   const Counts& counts = {});

/// Appends the frame, at `fps`, of the moment in `value`. It must be after all `frames` and within
/// the longest dance.
void AppendFrame(const nlohmann::json& value, const std::string& field, double fps,
                 const Counts& counts, std::vector<int64_t>* frames);

}  // namespace choreo::authoring
