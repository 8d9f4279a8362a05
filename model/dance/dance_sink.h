#pragma once

#include <cstdint>
#include <span>

#include "model/core/error.h"
#include "model/dance/transition.h"
#include "model/messages/dance_event.h"
#include "model/messages/quality_report.h"

namespace choreo {

/// Listens to a dance. Calls come one at a time, in order, from a worker thread or from the thread
/// that sent a message, with no lock of the stream held: they may call the stream (SetPaused,
/// Cancel), and must not block. The last call is OnSummary or OnError, exactly once.
class DanceSink {
 public:
  virtual ~DanceSink() = default;
  /// Output rate; `first_frame` counts output frames from time 0. The spans live for the call.
  virtual void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  /// Events belong to the frames delivered just before.
  virtual void OnEvent(const DanceEvent& event) = 0;
  /// Comes at each transition's end, after its frames and events.
  virtual void OnContinuation(const Continuation& continuation) = 0;
  virtual void OnSummary(const QualityReport& report) = 0;
  /// kCancelled after Cancel, else the failure.
  virtual void OnError(const Error& error) = 0;
};

}  // namespace choreo
