#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <mutex>
#include <string>

namespace choreo {

/// How far a long job is, and when it will be done: a bar that redraws itself on a terminal, a line
/// every ten seconds elsewhere, so that a log stays readable. Thread-safe.
class ProgressBar {
 public:
  /// Where the bar goes and how often. `now` stands in for the clock in tests.
  struct Output {
    std::ostream* stream;
    bool terminal;
    std::chrono::steady_clock::time_point (*now)();
  };

  /// To stderr. `total` is the number of steps; 0 or less where it is unknown (then no bar and no
  /// ETA).
  ProgressBar(std::string title, int64_t total);
  ProgressBar(std::string title, int64_t total, const Output& output);
  /// Ends the line if the job ended early (an exception).
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `steps` more are done; `note` stands behind the bar until the next call ("loss 3.21").
  void Advance(int64_t steps = 1, const std::string& note = {});
  /// Says how long it took. May be called again.
  void Finish();
  /// Prints a line of its own above the bar.
  void Print(const std::string& line);

 private:
  void Show(bool last);

  const std::string title_;
  const int64_t total_;
  const Output output_;
  const std::chrono::steady_clock::time_point start_;

  std::mutex mutex_;  // guards what follows and the stream
  int64_t done_ = 0;
  std::string note_;
  std::chrono::steady_clock::time_point shown_;
  bool finished_ = false;
};

/// "12 s", "3 min 07 s", "1 h 02 min".
std::string FormatDuration(double seconds);

}  // namespace choreo
