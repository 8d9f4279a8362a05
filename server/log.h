#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/caller.h"
#include "server/refusal.h"

namespace choreo {

/// Logs to stderr, from `level` on (spdlog's names), as text or as one JSON object per line.
void StartLog(const std::string& level, bool json);

/// Logs what gRPC would log itself, and counts the failed handshakes that it reports. Idempotent.
void ForwardGrpcLog();

/// A call that has ended.
struct CallRecord {
  std::string_view method;
  const Caller& caller;
  const grpc::Status& status;
  double seconds = 0;
  int64_t frames = 0;                   ///< at the client's rate
  double first_frame_s = 0;             ///< after it began; 0 without frames
  std::string_view model = {};          ///< requested; empty: none was found
  std::optional<uint64_t> seed = {};    ///< in use
  std::optional<Refusal> refusal = {};  ///< the reason for its end
};

/// A line to print outside the log, as an object like the log's with --log-format json.
std::string JsonLine(const std::string& level, const std::string& message);

/// Logs a call's single line at level info; of refused ones at most ten a second.
void LogCall(const CallRecord& call);
/// Logs how many refused calls had no line, if that has not been told. Call it regularly.
void LogLeftOutCalls();

}  // namespace choreo
