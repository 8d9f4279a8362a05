#include "client/live/midi_clock.h"

#include <unistd.h>

#include <cmath>
#include <string>

#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(midi_clock) {
  using namespace choreo;
  int ends[2];
  if (pipe(ends) != 0) fuzz::Fail("there is no pipe");
  fuzz::Decisions decisions(data, size);
  double now = 0;
  {
    live::MidiClock clock("/proc/self/fd/" + std::to_string(ends[0]));
    while (!decisions.over()) {
      now += 0.001 * decisions.Byte();
      const auto bytes = decisions.Take(decisions.Byte());
      if (write(ends[1], bytes.data(), bytes.size()) < 0) fuzz::Fail("a pipe is full");
      for (const double beat : clock.Take(now)) {
        if (!std::isfinite(beat)) fuzz::Fail("a beat at no time");
      }
    }
  }
  close(ends[0]);
  close(ends[1]);
  return 0;
}
