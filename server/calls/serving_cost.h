#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace choreo {

/// The CPU time per dance frame outside sampling: music, messages and gRPC. Starts at the cost of
/// music alone, measured once, then follows what this process uses for recent frames. Thread-safe.
class ServingCost {
 public:
  /// The process's totals since its start.
  struct Totals {
    double cpu_s = 0, sampling_s = 0;  ///< of all threads; the part spent on sampling
    uint64_t dance_frames = 0;         ///< frames sent to clients
  };

  ServingCost();
  /// `seconds_a_frame`: the initial cost.
  explicit ServingCost(double seconds_a_frame);

  /// Updates the cost from the time since the last Look, if only dances ran. Call regularly.
  void Look(const Totals& now, bool dances_alone);

  double seconds_a_frame() const;
  /// The share of this machine's usable cores that `frames_per_second` take.
  double LoadOf(double frames_per_second) const;

 private:
  const int cores_;
  mutable std::mutex mutex_;  // guards the members below
  double seconds_, frames_;   // decaying sums
  std::optional<Totals> last_;
};

}  // namespace choreo
