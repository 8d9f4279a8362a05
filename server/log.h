#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/caller.h"
#include "server/refusal.h"

namespace choreo {

/// Sends the log to stderr, from `level` on (as spdlog names them), as text or as one JSON object a
/// line.
void StartLog(const std::string& level, bool json);

/// A call that is over.
struct CallRecord {
  std::string_view method;
  const Caller& caller;
  const grpc::Status& status;
  double seconds = 0;
  int64_t frames = 0;                   ///< at the client's rate
  double first_frame_s = 0;             ///< after it began; 0 without frames
  std::string_view model = {};          ///< that it was for; empty: none was found
  std::optional<uint64_t> seed = {};    ///< in use
  std::optional<Refusal> refusal = {};  ///< that ended it
};

/// The one line that a call leaves, at level info.
void LogCall(const CallRecord& call);

}  // namespace choreo
