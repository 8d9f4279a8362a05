#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/core/error.h"

namespace choreo {

/// Why a call is turned away though nothing is wrong with it: what was lacking.
enum class Refusal {
  kStreams,        ///< --max-streams
  kStreamsOfPeer,  ///< --max-streams-of-peer
  kLoad,           ///< --max-load
  kLoadOfPeer,     ///< one caller's share of it
  kWaiting,        ///< --max-waiting
  kFileMusic,      ///< --max-file-music-mib
  kUnreadInfos,    ///< answers that wait for the caller to read them
  kToken,          ///< --tokens
  kDraining,       ///< the server goes away
};

/// As /metrics calls them, in the order of the enum.
inline constexpr std::array kRefusals = {
    "max_streams",    "max_streams_of_peer", "max_load", "max_load_of_peer", "max_waiting",
    "max_file_music", "unread_infos",        "token",    "draining",
};

/// An error that turns a call away.
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

/// None where the call is not turned away, but fails.
inline std::optional<Refusal> RefusalIn(const Error& error) {
  if (const auto* refused = dynamic_cast<const Refused*>(&error)) return refused->why();
  // Engines know of no calls: they have no room for further candidates.
  if (error.code() == ErrorCode::kResourceExhausted) return Refusal::kWaiting;
  return std::nullopt;
}

}  // namespace choreo
