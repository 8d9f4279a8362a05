#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "client/dance_config.h"
#include "model/messages/call_timing.h"
#include "model/messages/dance_event.h"
#include "model/messages/dance_header.h"
#include "model/messages/quality_report.h"
#include "model/motion/motion.h"

/// Messages from the server during a dance. For conventions see choreo_client.h.
namespace choreo::client {

using Header = DanceHeader;

/// Consecutive frames.
struct FrameBlock {
  int64_t first_frame = 0;  ///< at Header::fps
  std::vector<Pose> poses = {};
  std::vector<Contacts> contacts = {};  ///< of Skeleton::feet, 0 to 1
  uint32_t candidate = 0;               ///< of a transition
};

/// The most by which any joint of a dance misses a key, metres and degrees.
inline constexpr double kMaxKeyError_m = 0.001, kMaxKeyError_deg = 0.1;

using choreo::Beat, choreo::KeyReached, choreo::KeyRejected, choreo::Warning;

/// The server was lost and another one continues the dance. Frames before `frame` are not sent
/// again.
struct Resumed {
  std::string address = {};
  int64_t frame = 0;        ///< at Header::fps
  bool exact = true;        ///< false: the new server has another fingerprint
  std::string reason = {};  ///< the cause
};

/// The last message of a dance, with its quality. `frames` and `keys` cover the whole dance. The
/// other figures cover the frames from `measured_from` on, where the last server took over.
struct Report : QualityReport {
  CallTiming timing = {};
};

using Message = std::variant<Header, FrameBlock, KeyReached, KeyRejected, Beat, Warning,
                             Continuation, Resumed, Report>;

}  // namespace choreo::client
