#pragma once

#include <cstdint>
#include <span>

#include "model/core/error.h"
#include "model/dance/transition/transition.h"
#include "model/messages/dance_event.h"
#include "model/messages/quality_report.h"

namespace choreo {

/// Receives a dance. Its functions are called one at a time, from a worker or from a thread that
/// calls the stream, without any lock. They may call the stream (SetPaused, Cancel), and must not
/// block. The last call is OnSummary or OnError, exactly once.
class DanceSink {
 public:
  virtual ~DanceSink() = default;
  /// Receives frames at the output rate. `first_frame` counts output frames from time 0. The spans
  /// are valid during the call.
  virtual void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  /// Receives an event. Beats and reached keys follow their frame. Warnings about a transition
  /// precede its first frame. The answer to a message comes at once.
  virtual void OnEvent(const DanceEvent& event) = 0;
  /// Called after a transition's frames and events. Not called if none of its frames was sent.
  virtual void OnContinuation(const Continuation& continuation) = 0;
  virtual void OnSummary(const QualityReport& report) = 0;
  /// Receives kCancelled after Cancel, otherwise the failure.
  virtual void OnError(const Error& error) = 0;
};

}  // namespace choreo
