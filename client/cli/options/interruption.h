#pragma once

#include <signal.h>

namespace choreo::cli {

/// While this object exists, a first Ctrl-C or SIGTERM does not end the program, so that long work
/// can check for it and end cleanly. A second one ends the program at once. Create at most one
/// object at a time, on the main thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether a signal came during the lifetime of any of these objects.
  static bool Came();
  /// Throws Error(kCancelled) if a signal came.
  static void Check();

 private:
  struct sigaction before_[2];
};

}  // namespace choreo::cli
