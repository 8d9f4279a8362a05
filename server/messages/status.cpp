#include "server/messages/status.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/messages/message_error.h"

namespace choreo {
namespace {

constexpr size_t kMaxStatusBytes = 600;  // of a status message

struct Mapping {
  grpc::StatusCode code;
  const char* reason;  // for ErrorInfo
  bool retry;
};

Mapping Map(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return {grpc::StatusCode::INVALID_ARGUMENT, "INVALID_VALUE", false};
    case ErrorCode::kOutOfRange:
      return {grpc::StatusCode::OUT_OF_RANGE, "OUT_OF_SEQUENCE", false};
    case ErrorCode::kNotFound:
      return {grpc::StatusCode::NOT_FOUND, "NOT_FOUND", false};
    case ErrorCode::kFailedPrecondition:
      return {grpc::StatusCode::FAILED_PRECONDITION, "STATE_MISMATCH", false};
    case ErrorCode::kResourceExhausted:
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, "SERVER_FULL", true};
    case ErrorCode::kUnimplemented:
      return {grpc::StatusCode::UNIMPLEMENTED, "UNSUPPORTED_BY_MODEL", false};
    case ErrorCode::kUnavailable:
      return {grpc::StatusCode::UNAVAILABLE, "DRAINING", true};
    case ErrorCode::kCancelled:
      return {grpc::StatusCode::CANCELLED, "CANCELLED", false};
    case ErrorCode::kDeadlineExceeded:
      return {grpc::StatusCode::DEADLINE_EXCEEDED, "DEADLINE_EXCEEDED", false};
    case ErrorCode::kInternal:
      break;
  }
  return {grpc::StatusCode::INTERNAL, "INTERNAL", false};
}

// Turns text that may quote the client into one short line, because a status is sent in HTTP/2's
// trailers, which are limited to 8 KiB, and is read by people and written to logs. Keeps both ends
// of a long text: the beginning names the field, the end the limit.
std::string OneShortLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      line += c;
    } else {
      constexpr const char* kDigits = "0123456789abcdef";
      line += {'\\', 'x', kDigits[(c >> 4) & 15], kDigits[c & 15]};
    }
  }
  if (line.size() <= kMaxStatusBytes) return line;
  const auto inside = [&line](size_t at) {  // inside a multi-byte character
    return (static_cast<unsigned char>(line[at]) & 0xc0) == 0x80;
  };
  size_t head = 2 * kMaxStatusBytes / 3, tail = line.size() - kMaxStatusBytes / 3;
  while (inside(head)) --head;
  while (inside(tail)) ++tail;
  return line.substr(0, head) + "..." + line.substr(tail);
}

/// ErrorInfo's metadata, by name.
using Metadata = std::map<std::string, std::string>;

grpc::Status MakeStatus(const Mapping& mapping, std::string_view text, const Metadata& metadata,
                        const std::optional<Violation>& violation, double retry_after) {
  const std::string message = OneShortLine(text);
  google::rpc::Status status;
  status.set_code(mapping.code);
  status.set_message(message);

  google::rpc::ErrorInfo info;
  info.set_reason(mapping.reason);
  info.set_domain("choreo");
  for (const auto& [name, value] : metadata) {
    if (!value.empty()) (*info.mutable_metadata())[name] = OneShortLine(value);
  }
  status.add_details()->PackFrom(info);

  if (violation) {
    google::rpc::BadRequest bad_request;
    auto* said = bad_request.add_field_violations();
    said->set_field(violation->field);
    said->set_description(violation->description);
    status.add_details()->PackFrom(bad_request);
  }
  if (mapping.retry) {
    google::rpc::RetryInfo retry;
    const double whole = std::floor(retry_after);
    retry.mutable_retry_delay()->set_seconds(static_cast<int64_t>(whole));
    retry.mutable_retry_delay()->set_nanos(static_cast<int32_t>(1e9 * (retry_after - whole)));
    status.add_details()->PackFrom(retry);
  }
  return {mapping.code, message, status.SerializeAsString()};
}

}  // namespace

grpc::Status ToStatus(const Error& error, double retry_after) {
  const auto violation = error.field().empty() ? std::nullopt : std::optional(ViolationOf(error));
  Metadata metadata = {{"field", error.field()}};
  if (const auto* of_message = dynamic_cast<const MessageError*>(&error))
    metadata["keyframe_id"] = of_message->key_id();
  return MakeStatus(Map(error.code()), error.what(), metadata, violation, retry_after);
}

Violation ViolationOf(const Error& error) {
  // ErrorInfo has the field as named in the message text.
  return {OneShortLine(PathInMessage(error)), OneShortLine(error.Of("").what())};
}

grpc::Status Unauthenticated(const std::string& message, bool renewable) {
  return MakeStatus({grpc::StatusCode::UNAUTHENTICATED, "TOKEN_NEEDED", renewable}, message, {}, {},
                    0);
}

const char* NameOf(grpc::StatusCode code) {
  // Indexed by status code.
  static constexpr std::array kNames = {
      "OK",
      "CANCELLED",
      "UNKNOWN",
      "INVALID_ARGUMENT",
      "DEADLINE_EXCEEDED",
      "NOT_FOUND",
      "ALREADY_EXISTS",
      "PERMISSION_DENIED",
      "RESOURCE_EXHAUSTED",
      "FAILED_PRECONDITION",
      "ABORTED",
      "OUT_OF_RANGE",
      "UNIMPLEMENTED",
      "INTERNAL",
      "UNAVAILABLE",
      "DATA_LOSS",
      "UNAUTHENTICATED",
  };
  const auto number = static_cast<size_t>(code);
  return number < kNames.size() ? kNames[number] : "UNKNOWN";
}

}  // namespace choreo
