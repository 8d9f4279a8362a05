#include "server/calls/serving.h"

#include <unistd.h>

#include <random>

#include "server/process/process_usage.h"

namespace choreo {

uint64_t Serving::FreshSeed() {
  std::random_device device;
  // 53 bits: exact in JSON and in JavaScript.
  return (uint64_t{device()} << 21) ^ device() >> 11;
}

void Serving::LookAtCost() {
  ServingCost::Totals totals{.cpu_s = CpuSeconds(getpid()), .dance_frames = tally.dance_frames};
  for (const auto& [model, figures] : models.figures())
    totals.sampling_s += figures.stats.cpu_seconds;
  cost.Look(totals, frames.OnlyDanced());
}

}  // namespace choreo
