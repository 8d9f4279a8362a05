#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace choreo {

/// Why something failed. server/messages/status.cpp maps each code to one gRPC status.
enum class ErrorCode {
  kInvalidArgument,     ///< a value that is never valid
  kOutOfRange,          ///< a valid value at the wrong moment (a gap in the audio)
  kNotFound,            ///< a model, device or file that does not exist
  kFailedPrecondition,  ///< a continuation of another model or build
  kResourceExhausted,   ///< no capacity is left
  kUnimplemented,       ///< a control that this model lacks
  kUnavailable,         ///< the server is draining
  kCancelled,
  kDeadlineExceeded,
  kInternal,
};

/// What a caller can do about a failure.
enum class Remedy {
  kNone,
  kTakePart,      ///< take a part of the sound, which is too long
  kConvert,       ///< convert the sound file to another format
  kGrantFrames,   ///< grant frames, so that keys grant none
  kSetEnd,        ///< set the frame at which the dance ends
  kAllowInexact,  ///< allow a dance to continue in another way
};

/// What this project throws; other exceptions derive from it. `field()` is the path of the
/// offending value in the caller's terms, such as "keyframes[3].rotations[16]", or empty. `what()`
/// names the field, the value and the limit.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, std::string field, const std::string& message,
        Remedy remedy = Remedy::kNone)
      : std::runtime_error(WithoutNul(field.empty() ? message : field + ": " + message)),
        code_(code),
        remedy_(remedy),
        field_(std::move(field)) {}

  ErrorCode code() const noexcept { return code_; }
  Remedy remedy() const noexcept { return remedy_; }
  const std::string& field() const noexcept { return field_; }
  /// Returns the same error for `field`, for callers that know the value by another name.
  Error Of(const std::string& field) const {
    std::string message = what();
    if (!field_.empty() && message.starts_with(field_ + ": ")) message.erase(0, field_.size() + 2);
    return {code_, field, message, remedy_};
  }

 private:
  /// Escapes NULs, because what() would end at the first one.
  static std::string WithoutNul(std::string text) {
    for (size_t at; (at = text.find('\0')) != std::string::npos;) text.replace(at, 1, "\\x00");
    return text;
  }

  ErrorCode code_;
  Remedy remedy_;
  std::string field_;
};

/// Shorthand for the most common code.
inline Error InvalidArgument(std::string field, const std::string& message) {
  return Error(ErrorCode::kInvalidArgument, std::move(field), message);
}

}  // namespace choreo
