#include "server/status.h"

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace choreo {
namespace {

constexpr int kRetrySeconds = 1;

struct Mapping {
  grpc::StatusCode code;
  const char* reason;  // of ErrorInfo
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

}  // namespace

grpc::Status ToStatus(const Error& error) {
  const Mapping mapping = Map(error.code());
  google::rpc::Status status;
  status.set_code(mapping.code);
  status.set_message(error.what());

  google::rpc::ErrorInfo info;
  info.set_reason(mapping.reason);
  info.set_domain("choreo");
  if (!error.field().empty()) (*info.mutable_metadata())["field"] = error.field();
  status.add_details()->PackFrom(info);

  if (!error.field().empty()) {
    google::rpc::BadRequest bad_request;
    auto* violation = bad_request.add_field_violations();
    violation->set_field(error.field());
    violation->set_description(error.what());
    status.add_details()->PackFrom(bad_request);
  }
  if (mapping.retry) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(kRetrySeconds);
    status.add_details()->PackFrom(retry);
  }
  return {mapping.code, error.what(), status.SerializeAsString()};
}

}  // namespace choreo
