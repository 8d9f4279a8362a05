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
  /// `device`: a file that raw MIDI comes from, as /dev/snd/midiC1D0. Throws Error(kNotFound),
  /// whose field is --midi-clock, where it cannot be read.
  explicit MidiClock(const std::string& device);
  ~MidiClock();
  MidiClock(const MidiClock&) = delete;
  MidiClock& operator=(const MidiClock&) = delete;

  /// Reads what has come until `now`, seconds of the music, without blocking. From the fifth beat
  /// on, at every second one, the next eight; otherwise none.
  std::vector<double> Take(double now);

 private:
  void Tick(double now, std::vector<double>* beats);
  std::vector<double> Ahead() const;

  int file_;
  std::optional<int64_t> tick_;  // the last one; none: the clock stands
  std::deque<double> times_;     // of the last ticks
};

}  // namespace choreo::live
