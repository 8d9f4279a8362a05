#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/connections/caller.h"
#include "server/messages/refusal.h"

namespace choreo {

/// Starts logging to stderr, from `level` up (spdlog's names), as text or as one JSON object per
/// line.
void StartLog(const std::string& level, bool json);

/// Redirects gRPC's log into this one, and counts the failed handshakes that it reports.
/// Idempotent.
void ForwardGrpcLog();

/// A call that has ended.
struct CallRecord {
  std::string_view method;
  const Caller& caller;
  const grpc::Status& status;
  double seconds = 0;
  int64_t frames = 0;           ///< at the client's rate
  double first_frame_s = 0;     ///< time from the call's start to its first frame; 0 without frames
  std::string_view model = {};  ///< the requested model; empty: not found
  std::optional<uint64_t> seed = {};    ///< the seed used
  std::optional<Refusal> refusal = {};  ///< why the call was refused
};

/// Formats a line to print outside the log, as the JSON object of --log-format json.
std::string JsonLine(const std::string& level, const std::string& message);

/// Logs one line for a call, at level info. Logs at most ten refused calls a second.
void LogCall(const CallRecord& call);
/// Logs how many refused calls LogCall has left out since the last report. Call regularly.
void LogLeftOutCalls();

}  // namespace choreo
