#include "client/live/midi_clock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <span>

#include "client/live/sound.h"
#include "model/core/error.h"

namespace choreo::live {
namespace {

constexpr uint8_t kTick = 0xF8, kStart = 0xFA, kContinue = 0xFB, kStop = 0xFC;
constexpr int64_t kBeat = 24;  // ticks
// The largest and least number of ticks for estimating the tempo. Each tick is late by up to a
// piece of sound, which is 1 % over four beats.
constexpr size_t kMaxTicks = 8 * kBeat, kMinTicks = 4 * kBeat;
constexpr int kAhead = 8;           // beats: about the reach of transitions
constexpr double kMinPeriod = 0.2;  // seconds per beat; less would exceed the limit of beats
constexpr size_t kMaxBytes = size_t{1} << 17;  // per read: twice what a pipe holds
constexpr double kPauseSeconds = 0.25;         // between ticks, longer than at the slowest tempo

}  // namespace

MidiClock::MidiClock(const std::string& device)
    : device_(device), file_(open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {
  if (file_ < 0) {
    throw Error(ErrorCode::kNotFound, "--midi-clock",
                "\"" + device + "\" can't be read: " + std::strerror(errno));
  }
  struct stat kind {};
  fstat(file_, &kind);
  if (S_ISCHR(kind.st_mode) || S_ISFIFO(kind.st_mode)) return;
  close(file_);
  throw InvalidArgument("--midi-clock", "\"" + device + "\" is a " +
                                            (S_ISDIR(kind.st_mode) ? "folder" : "file") +
                                            ", not a device of raw MIDI");
}

MidiClock::~MidiClock() { close(file_); }

std::vector<double> MidiClock::Take(double now) {
  // Bytes received since the last piece of sound are half a piece old on average.
  const double then = now - 0.5 * kPieceSeconds;
  std::vector<double> beats;
  std::array<uint8_t, 256> bytes;
  size_t all = 0;
  ssize_t size = 0;
  for (; (size = read(file_, bytes.data(), bytes.size())) > 0;) {
    all += static_cast<size_t>(size);
    if (all > kMaxBytes) {
      throw InvalidArgument("--midi-clock", "\"" + device_ + "\" is not a MIDI device: more than " +
                                                std::to_string(kMaxBytes) + " bytes came at once");
    }
    for (const uint8_t byte : std::span(bytes).first(static_cast<size_t>(size))) {
      if (byte == kStart) tick_ = -1;
      if (byte == kContinue && !tick_) tick_ = -1;
      if (byte == kStart || byte == kContinue) times_.clear();
      if (byte == kStop) tick_.reset();
      if (byte == kTick) Tick(then, &beats);
    }
  }
  if (size < 0 && errno != EAGAIN && errno != EINTR) {
    throw Error(ErrorCode::kUnavailable, "--midi-clock",
                "\"" + device_ + "\" is lost: " + std::strerror(errno));
  }
  return beats;
}

void MidiClock::Tick(double now, std::vector<double>* beats) {
  if (!tick_) return;  // the position of its beats is unknown
  ++*tick_;
  if (!times_.empty() && now - times_.back() > kPauseSeconds) times_.clear();
  times_.push_back(now);
  if (times_.size() > kMaxTicks) times_.pop_front();
  if (*tick_ % (2 * kBeat) == 0 && times_.size() > kMinTicks) *beats = Ahead();
}

std::vector<double> MidiClock::Ahead() const {
  // Fits a line through the ticks, each up to one piece of sound late.
  const auto count = static_cast<double>(times_.size());
  double mean = 0, slope = 0, squares = 0;
  for (const double time : times_) mean += time / count;
  for (size_t i = 0; i < times_.size(); ++i) {
    const double x = static_cast<double>(i) - 0.5 * (count - 1);
    slope += x * (times_[i] - mean);
    squares += x * x;
  }
  const double period = slope / squares * kBeat;
  const double last = mean + slope / squares * 0.5 * (count - 1);
  std::vector<double> beats;
  if (period < kMinPeriod) return beats;
  for (int beat = 1; beat <= kAhead; ++beat) beats.push_back(last + beat * period);
  return beats;
}

}  // namespace choreo::live
