#pragma once

#include <cstdint>
#include <span>

#include "model/core/error.h"
#include "model/dance/transition.h"
#include "model/messages/dance_event.h"
#include "model/messages/quality_report.h"

namespace choreo {

/// Listens to a dance. Calls come one at a time, from a worker or from a thread that calls the
/// stream, which holds no lock meanwhile. They may call the stream (SetPaused, Cancel), and must
/// not block. The last call is OnSummary or OnError, exactly once.
class DanceSink {
 public:
  virtual ~DanceSink() = default;
  /// Frames at the output rate, at which `first_frame` is counted from time 0, too. The spans live
  /// for the call.
  virtual void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  /// Beats and reached keys follow their frame, warnings about a transition precede its first one,
  /// and the answer to a message comes at once.
  virtual void OnEvent(const DanceEvent& event) = 0;
  /// A transition is over: its frames and events have come. None if not one of its frames came.
  virtual void OnContinuation(const Continuation& continuation) = 0;
  virtual void OnSummary(const QualityReport& report) = 0;
  /// kCancelled after Cancel, else the failure.
  virtual void OnError(const Error& error) = 0;
};

}  // namespace choreo
