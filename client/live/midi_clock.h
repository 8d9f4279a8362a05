#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace choreo::live {

/// Predicts beats from the MIDI clock of a DJ program, a drum machine or the like. A beat has 24
/// ticks; the first beat's first tick follows Start. Not thread-safe.
class MidiClock {
 public:
  /// `device`: a source of raw MIDI, such as /dev/snd/midiC1D0, or a named pipe. Throws
  /// Error(kNotFound), whose field is --midi-clock, if it cannot be read, and
  /// Error(kInvalidArgument) for a regular file or a folder.
  explicit MidiClock(const std::string& device);
  ~MidiClock();
  MidiClock(const MidiClock&) = delete;
  MidiClock& operator=(const MidiClock&) = delete;

  /// Reads, without blocking, the bytes that arrived until `now`, in seconds of the music. At every
  /// second beat, from the fifth on, returns the next eight beats; otherwise returns none. Throws
  /// Error(kUnavailable) if the device is lost, and Error(kInvalidArgument) if it sends more than
  /// MIDI can.
  std::vector<double> Take(double now);
  /// Whether the clock was started and has not been stopped.
  bool runs() const { return tick_.has_value(); }

 private:
  void Tick(double now, std::vector<double>* beats);
  std::vector<double> Ahead() const;

  std::string device_;
  int file_;
  std::optional<int64_t> tick_;  // number of the last tick; none: the clock is stopped
  std::deque<double> times_;     // of recent ticks
};

}  // namespace choreo::live
