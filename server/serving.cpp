#include "server/serving.h"

#include <random>

#include "model/core/error.h"

namespace choreo {

Scheduler& Serving::FindModel(const std::string& name, const std::string& field) const {
  std::string known;
  for (const auto& scheduler : models) {
    if (name.empty() || scheduler->model().name == name) return *scheduler;
    known += (known.empty() ? "\"" : ", \"") + scheduler->model().name + '"';
  }
  throw Error(ErrorCode::kNotFound, field, "no model \"" + name + "\"; this server has " + known);
}

void Serving::RequireTime(const Scheduler& scheduler) const {
  constexpr double kFull = 0.9;  // the rest is for what is not measured: gRPC, decoding
  const double load = scheduler.stats().load;
  if (load < kFull) return;
  throw Error(ErrorCode::kResourceExhausted, "",
              "model \"" + scheduler.model().name +
                  "\" is busy: " + std::to_string(static_cast<int>(100 * load)) +
                  " % of its time goes to frames that are due now, of at most 90 %");
}

uint64_t Serving::FreshSeed() {
  std::random_device device;
  // 53 bits: exact in JSON and in JavaScript.
  return (uint64_t{device()} << 21) ^ device() >> 11;
}

}  // namespace choreo
