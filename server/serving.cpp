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

uint64_t Serving::FreshSeed() {
  std::random_device device;
  // 53 bits: exact in JSON and in JavaScript.
  return (uint64_t{device()} << 21) ^ device() >> 11;
}

}  // namespace choreo
