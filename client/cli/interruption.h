#pragma once

#include <signal.h>

namespace choreo::cli {

/// As long as it lives, a first Ctrl-C or SIGTERM does not end the program: work that leaves
/// something behind asks for it now and then, and ends in order. A second one ends it at once.
/// There is one at a time, on the main thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether one came while any of these lived.
  static bool Came();
  /// Throws Error(kCancelled) if so.
  static void Check();

 private:
  struct sigaction before_[2];
};

}  // namespace choreo::cli
