#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace choreo {

/// The CPU time that a dance's frame takes beside its sampling: music, messages, gRPC. At first
/// that of music alone, measured once; then what this process used for recent frames. Thread-safe.
class ServingCost {
 public:
  /// Of the process since its start.
  struct Totals {
    double cpu_s = 0, sampling_s = 0;  ///< of all threads; of them, what sampling took
    uint64_t dance_frames = 0;         ///< that went to clients
  };

  ServingCost();
  /// `seconds_a_frame` to begin with.
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
