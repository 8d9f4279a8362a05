#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace choreo::live {

/// The beats of whoever keeps a MIDI clock: a DJ's program, a drum machine. 24 ticks are a beat;
/// the first tick behind a Start is one. Not thread-safe.
class MidiClock {
 public:
  /// `device`: what raw MIDI comes from, as /dev/snd/midiC1D0, or a named pipe. Throws
  /// Error(kNotFound), whose field is --midi-clock, where it cannot be read, and
  /// Error(kInvalidArgument) for a file or a folder.
  explicit MidiClock(const std::string& device);
  ~MidiClock();
  MidiClock(const MidiClock&) = delete;
  MidiClock& operator=(const MidiClock&) = delete;

  /// Reads what has come until `now`, seconds of the music, without blocking. From the fifth beat
  /// on, at every second one, the next eight; otherwise none. Throws Error(kUnavailable) for a
  /// device that is lost, Error(kInvalidArgument) for one that says more than any MIDI device.
  std::vector<double> Take(double now);
  /// Whether it was started and not stopped since.
  bool runs() const { return tick_.has_value(); }

 private:
  void Tick(double now, std::vector<double>* beats);
  std::vector<double> Ahead() const;

  std::string device_;
  int file_;
  std::optional<int64_t> tick_;  // the last one; none: the clock stands
  std::deque<double> times_;     // of the last ticks
};

}  // namespace choreo::live
