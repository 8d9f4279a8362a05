#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/core/error.h"

namespace choreo {

/// Why a valid call is refused: the exhausted resource, named by its setting.
enum class Refusal {
  kStreams,        ///< --max-streams
  kStreamsOfPeer,  ///< --max-streams-of-peer
  kLoad,           ///< --max-load
  kLoadOfPeer,     ///< one caller's share of --max-load
  kWaiting,        ///< --max-waiting
  kFileMusic,      ///< --max-file-music-mib
  kUnreadInfos,    ///< answers that wait for the caller to read them
  kToken,          ///< --tokens
  kDraining,       ///< the server is stopping
};

/// Names in /metrics, in the order of the enum.
inline constexpr std::array kRefusals = {
    "max_streams",    "max_streams_of_peer", "max_load", "max_load_of_peer", "max_waiting",
    "max_file_music", "unread_infos",        "token",    "draining",
};

/// What an address did, so that its new connection is closed before gRPC gets it.
enum class ConnectionRefusal {
  kFlood,   ///< sent a flood, less than ten seconds ago
  kResets,  ///< reset more calls than can be ended
  kRate,    ///< connected too often
};

/// Names in /metrics, in the order of the enum.
inline constexpr std::array kConnectionRefusals = {"flood", "resets", "rate"};

/// An error that refuses a call.
class Refused : public Error {
 public:
  Refused(Refusal why, const std::string& message)
      : Error(why == Refusal::kDraining ? ErrorCode::kUnavailable : ErrorCode::kResourceExhausted,
              "", message),
        why_(why) {}
  Refusal why() const { return why_; }

 private:
  Refusal why_;
};

/// The reason for a refusal; none if the call failed for another reason.
inline std::optional<Refusal> RefusalIn(const Error& error) {
  if (const auto* refused = dynamic_cast<const Refused*>(&error)) return refused->why();
  // Engines do not throw Refused. They report that they have no room for more candidates.
  if (error.code() == ErrorCode::kResourceExhausted) return Refusal::kWaiting;
  return std::nullopt;
}

}  // namespace choreo
