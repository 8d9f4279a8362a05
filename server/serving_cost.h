#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace choreo {

/// The CPU time that a dance's frame takes beside its sampling: music, messages, gRPC. Starts as
/// that of music alone, measured once; then follows this process's use for recent frames.
/// Thread-safe.
class ServingCost {
 public:
  /// The process's totals since its start.
  struct Totals {
    double cpu_s = 0, sampling_s = 0;  ///< all threads' time; sampling's part of it
    uint64_t dance_frames = 0;         ///< frames that went to clients
  };

  ServingCost();
  /// `seconds_a_frame`: the cost to begin with.
  explicit ServingCost(double seconds_a_frame);

  /// Learns from the time since the last look, if it went to dances alone. Call regularly.
  void Look(const Totals& now, bool dances_alone);

  double seconds_a_frame() const;
  /// The share of this machine's usable cores that this many frames a second take.
  double LoadOf(double frames_per_second) const;

 private:
  const int cores_;
  mutable std::mutex mutex_;  // guards the members below
  double seconds_, frames_;   // decaying sums
  std::optional<Totals> last_;
};

}  // namespace choreo
