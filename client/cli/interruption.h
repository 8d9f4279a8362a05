#pragma once

#include <signal.h>

namespace choreo::cli {

/// While it exists, a first Ctrl-C or SIGTERM does not end the program: long work checks for it and
/// ends cleanly. A second one ends it at once. One at a time, on the main thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether one came during the lifetime of any of these.
  static bool Came();
  /// Throws Error(kCancelled) if so.
  static void Check();

 private:
  struct sigaction before_[2];
};

}  // namespace choreo::cli
