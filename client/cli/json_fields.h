#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/limits.h"

/// How the files that people write (key files, path files) are read. Errors are
/// Error(kInvalidArgument) whose field is NAME:LIST[i].MEMBER, naming value and limit.
namespace choreo::cli {

/// The largest number of a frame in a file: behind the end of any dance.
inline constexpr uint64_t kMaxFrameNumber = 1'000'000'000;
/// Whether a value in JSON is one: whole, from 0 on.
template <typename Json>
bool IsFrameNumber(const Json& value) {
  return value.is_number_unsigned() && value.template get<uint64_t>() <= kMaxFrameNumber;
}
/// Behind the end of any dance, and far from where numbers of frames end.
inline constexpr double kMaxSeconds = 1e9;
/// Seconds of the longest dance.
inline constexpr double kLongestDance = kMaxDanceFrames / kModelFps;
/// Throws Error(kInvalidArgument) of this field for seconds beyond it.
void CheckInADance(double seconds, const std::string& field);

/// A value as messages show it: at most 40 characters.
std::string Shown(const nlohmann::json& value);

double JsonNumber(const nlohmann::json& value, const std::string& field);

/// More bytes than any text has that people write.
inline constexpr size_t kMostText = size_t{64} << 20;

/// The text of a file. Throws Error(kNotFound) where it cannot be opened; `kind` is what it should
/// have been, "key file". Error(kInvalidArgument) for a folder, and for more than kMostText.
std::string ReadText(const std::filesystem::path& path, const std::string& kind);

/// A text as JSON. Where it is no JSON, and for a member that is there twice, the
/// field says how far the text could be read: NAME:LIST[i].MEMBER.
nlohmann::json ParseJson(std::string_view text, const std::string& name);

/// The list of this name in the outermost object of the file `name`; at least one entry.
const nlohmann::json& ListIn(const nlohmann::json& file, const std::string& name,
                             const std::string& list);

/// Checks that the value is an object with no member but these; `described` is how the message says
/// what it may have.
void CheckMembers(const nlohmann::json& value, const std::string& field,
                  std::initializer_list<std::string_view> members, const std::string& described);

/// The same of the outermost object of the file `name`.
void CheckFileMembers(const nlohmann::json& file, const std::string& name,
                      std::initializer_list<std::string_view> members,
                      const std::string& described);

/// When: `time`, in seconds, or `frame`, exactly one of them.
struct Moment {
  double time_s = 0;
  std::optional<int64_t> frame = {};
};
Moment ParseMoment(const nlohmann::json& value, const std::string& field);

/// Appends the frame, at `fps`, of a point in time: behind those before it, within the longest
/// dance.
void AppendFrame(const nlohmann::json& value, const std::string& field, double fps,
                 std::vector<int64_t>* frames);

}  // namespace choreo::cli
