#include "client/retry_advice.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "client/choreo_client.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace choreo::client {
namespace {

ErrorCode ToCode(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::INVALID_ARGUMENT:
      return ErrorCode::kInvalidArgument;
    case grpc::StatusCode::OUT_OF_RANGE:
      return ErrorCode::kOutOfRange;
    case grpc::StatusCode::NOT_FOUND:
      return ErrorCode::kNotFound;
    case grpc::StatusCode::FAILED_PRECONDITION:
      return ErrorCode::kFailedPrecondition;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return ErrorCode::kResourceExhausted;
    case grpc::StatusCode::UNIMPLEMENTED:
      return ErrorCode::kUnimplemented;
    case grpc::StatusCode::UNAVAILABLE:
      return ErrorCode::kUnavailable;
    case grpc::StatusCode::UNAUTHENTICATED:
      return ErrorCode::kFailedPrecondition;  // the server needs a token
    case grpc::StatusCode::CANCELLED:
      return ErrorCode::kCancelled;
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return ErrorCode::kDeadlineExceeded;
    default:
      return ErrorCode::kInternal;
  }
}

/// The detail of type T, if the status carries one.
template <typename T>
bool FindDetail(const grpc::Status& status, T* detail) {
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) return false;
  for (const auto& any : details.details()) {
    if (any.UnpackTo(detail)) return true;
  }
  return false;
}

/// The field that the server names in its error; empty if none.
std::string FieldOf(const grpc::Status& status) {
  google::rpc::ErrorInfo info;
  if (FindDetail(status, &info)) {
    const auto field = info.metadata().find("field");
    if (field != info.metadata().end()) return field->second;
  }
  google::rpc::BadRequest bad_request;
  if (!FindDetail(status, &bad_request) || bad_request.field_violations_size() == 0) return "";
  return bad_request.field_violations(0).field();
}

/// gRPC's messages for a server that is not reached.
constexpr const char* kAway[] = {"failed to connect to all addresses",
                                 "connections to all backends failing"};

/// gRPC's words for a server whose health is not serving.
constexpr const char* kUnhealthy = "backend unhealthy";

/// Extracts the reason from a message of gRPC's for a server that is not reached.
std::string ReasonIn(const std::string& message) {
  constexpr std::string_view kLast = "last error: ", kFailed = "Failed to connect to remote host: ";
  const size_t last = message.find(kLast);
  if (last == message.npos) return "nobody answers";
  std::string_view reason = std::string_view(message).substr(last + kLast.size());
  // Removes a code and an address in front: "UNKNOWN: ipv4:127.0.0.1:50051: ".
  for (size_t end; (end = reason.find(' ')) != reason.npos && end > 0 && reason[end - 1] == ':';)
    reason.remove_prefix(end + 1);
  if (reason.starts_with(kFailed)) reason.remove_prefix(kFailed.size());
  std::string text(reason);
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

/// Suggests, by the symptom, which TLS option may be missing or wrong for a server that is not
/// reached. Empty if unknown.
std::string TlsHint(const std::string& message, const Options& options) {
  // A TLS server closes connections without TLS, and with a client certificate that it rejects.
  if (message.ends_with("ocket closed")) {
    if (!options.tls) return "; it may need TLS, which is off";
    return options.client_certificate.empty() ? "; it may need a client certificate"
                                              : "; it may refuse this client certificate";
  }
  if (message.ends_with("certificate verify failed"))
    return "; its certificate has expired, or is not from the trusted authority (--ca)";
  return "";
}

bool IsUnhealthy(const grpc::Status& status) {
  return IsAway(status) && status.error_message().ends_with(kUnhealthy);
}

constexpr const char* kFingerprintField = "config.continuation.fingerprint";

/// Whether other replicas may have another value of this field, set when they were started.
bool IsTheReplicas(const std::string& field) {
  return field == "config.model" || field == kFingerprintField ||
         field == "config.continuation.skeleton";
}

}  // namespace

Error ToError(const grpc::Status& status) {
  const std::string field = FieldOf(status);
  std::string message = status.error_message();
  if (!field.empty()) {
    // Error's constructor puts the field in front.
    if (message.starts_with(field + ": ")) message.erase(0, field.size() + 2);
  }
  if (message.empty()) message = "the server failed without saying why";
  return {ToCode(status.error_code()), field, message};
}

bool IsAway(const grpc::Status& status) {
  const std::string& message = status.error_message();
  return status.error_code() == grpc::StatusCode::UNAVAILABLE &&
         std::ranges::any_of(kAway, [&](const char* words) { return message.starts_with(words); });
}

Error ToError(const grpc::Status& status, const std::string& address, const Options& options) {
  const Error error = ToError(status);
  google::rpc::RetryInfo info;
  if (error.code() == ErrorCode::kResourceExhausted && FindDetail(status, &info)) {
    return {error.code(), address,
            std::string(error.what()) + "; it asks to try again in " +
                std::to_string(std::max<int64_t>(1, info.retry_delay().seconds())) +
                " s; another server may have room"};
  }
  if (error.code() != ErrorCode::kUnavailable) return error;
  const std::string message =
      IsUnhealthy(status) ? "the server takes no calls: it drains, or an engine of it fails"
      : IsAway(status)    ? "no server can be reached: " + ReasonIn(error.what())
                          : error.what();
  return {ErrorCode::kUnavailable, address, message + TlsHint(message, options)};
}

grpc::Status RefusedFingerprint(const std::string& begun, const std::string& address,
                                const std::string& found) {
  google::rpc::BadRequest refused;
  google::rpc::BadRequest::FieldViolation& violation = *refused.add_field_violations();
  violation.set_field(kFingerprintField);
  violation.set_description("begun by \"" + begun + "\"; " + address + " has \"" + found +
                            "\", which allow_inexact_resume would let go on");
  google::rpc::Status details;
  details.add_details()->PackFrom(refused);
  return {grpc::StatusCode::FAILED_PRECONDITION, violation.field() + ": " + violation.description(),
          details.SerializeAsString()};
}

RetryAdvice AdviceFor(const grpc::Status& status) {
  google::rpc::RetryInfo info;
  const bool invited = FindDetail(status, &info);
  const double wait = invited ? static_cast<double>(info.retry_delay().seconds()) +
                                    1e-9 * info.retry_delay().nanos()
                              : 0.0;
  const grpc::StatusCode code = status.error_code();
  const bool here = invited || code == grpc::StatusCode::UNAVAILABLE;
  const bool broken = code == grpc::StatusCode::INTERNAL || code == grpc::StatusCode::UNKNOWN;
  google::rpc::ErrorInfo why;
  const bool leaving =
      IsUnhealthy(status) || (FindDetail(status, &why) && why.reason() == "DRAINING");
  return {here, here || broken || IsTheReplicas(FieldOf(status)), wait, leaving};
}

}  // namespace choreo::client
