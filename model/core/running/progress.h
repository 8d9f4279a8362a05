#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <mutex>
#include <string>

namespace choreo {

/// Shows the progress of a long job and its estimated end. Draws a bar on a terminal; elsewhere
/// prints a line every ten seconds, so that logs stay readable. Thread-safe.
class ProgressBar {
 public:
  /// Where and how often the bar is printed. Tests replace `now`.
  struct Output {
    std::ostream* stream;
    bool terminal;
    std::chrono::steady_clock::time_point (*now)();
  };

  /// Prints to stderr. `total`: the number of steps; 0 or less if unknown, which omits bar and ETA.
  ProgressBar(std::string title, int64_t total);
  ProgressBar(std::string title, int64_t total, const Output& output);
  /// Ends the line if the job ended early (by an exception).
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Counts `steps` as done. Shows `note` ("loss 3.21") after the bar until the next call.
  void Advance(int64_t steps = 1, const std::string& note = {});
  /// Prints the total time. Further calls do nothing.
  void Finish();
  /// Prints a line above the bar.
  void Print(const std::string& line);

 private:
  void Show(bool last);

  const std::string title_;
  const int64_t total_;
  const Output output_;
  const std::chrono::steady_clock::time_point start_;

  std::mutex mutex_;  // guards the members below and the stream
  int64_t done_ = 0;
  std::string note_;
  std::chrono::steady_clock::time_point shown_;
  bool finished_ = false;
};

/// Formats a duration: "12 s", "3 min 07 s", "1 h 02 min".
std::string FormatDuration(double seconds);

}  // namespace choreo
