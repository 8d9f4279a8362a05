#include "model/core/running/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

namespace choreo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 30;
constexpr Clock::duration kRedraw = std::chrono::milliseconds(100);
constexpr Clock::duration kLogLine = std::chrono::seconds(10);

}  // namespace

std::string FormatDuration(double seconds) {
  const auto whole = std::llround(std::max(0.0, seconds));
  const auto two = [](long long number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
  };
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + two(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + two(whole % 3600 / 60) + " min";
}

ProgressBar::ProgressBar(std::string title, int64_t total)
    : ProgressBar(std::move(title), total,
                  Output{&std::cerr, isatty(STDERR_FILENO) != 0, &Clock::now}) {}

ProgressBar::ProgressBar(std::string title, int64_t total, const Output& output)
    : title_(std::move(title)),
      total_(total),
      output_(output),
      start_(output.now()),
      shown_(start_) {}

ProgressBar::~ProgressBar() {
  const std::lock_guard lock(mutex_);
  if (!finished_ && output_.terminal) *output_.stream << '\n' << std::flush;
}

void ProgressBar::Advance(int64_t steps, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += steps;
  note_ = note;
  const auto now = output_.now();
  if (now - shown_ < (output_.terminal ? kRedraw : kLogLine)) return;
  shown_ = now;
  Show(false);
}

void ProgressBar::Finish() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(finished_, true)) return;
  Show(true);
}

void ProgressBar::Print(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (output_.terminal) *output_.stream << "\r\x1b[K";
  *output_.stream << line << '\n' << std::flush;
}

void ProgressBar::Show(bool last) {
  const double elapsed = std::chrono::duration<double>(output_.now() - start_).count();
  std::string line = title_;
  if (total_ > 0) {
    const double part =
        std::clamp(static_cast<double>(done_) / static_cast<double>(total_), 0.0, 1.0);
    const int filled = static_cast<int>(part * kWidth);
    if (output_.terminal)
      line.append(" [").append(filled, '=').append(kWidth - filled, ' ').append("]");
    char numbers[80];
    std::snprintf(numbers, sizeof(numbers), " %3.0f %% %lld/%lld", std::floor(100 * part),
                  static_cast<long long>(done_), static_cast<long long>(total_));
    line += numbers;
    if (!last && part > 0) line += ", " + FormatDuration(elapsed * (1 - part) / part) + " left";
  } else {
    line += " " + std::to_string(done_);
  }
  if (last) line += ", took " + FormatDuration(elapsed);
  if (!note_.empty()) line += "  " + note_;
  if (output_.terminal) *output_.stream << "\r\x1b[K";
  *output_.stream << line;
  if (last || !output_.terminal) *output_.stream << '\n';
  *output_.stream << std::flush;
}

}  // namespace choreo
