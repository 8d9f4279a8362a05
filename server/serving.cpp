#include "server/serving.h"

#include <spdlog/spdlog.h>

#include <random>

#include "model/core/error.h"

namespace choreo {
namespace {

// Paths and velocity factors had a model of their own before 0.2.0.
constexpr const char* kFormerControls = "controllers";

}  // namespace

Scheduler& Serving::FindModel(const std::string& name, const std::string& field) const {
  std::string known;
  for (const auto& scheduler : models) {
    if (name.empty() || scheduler->model().name == name) return *scheduler;
    known += (known.empty() ? "\"" : ", \"") + scheduler->model().name + '"';
  }
  if (name == kFormerControls) {
    spdlog::warn("{}: \"{}\" is the first model's former name; it takes controls, too", field,
                 name);
    return *models.front();
  }
  throw Error(ErrorCode::kNotFound, field, "no model \"" + name + "\"; this server has " + known);
}

uint64_t Serving::FreshSeed() {
  std::random_device device;
  // 53 bits: exact in JSON and in JavaScript.
  return (uint64_t{device()} << 21) ^ device() >> 11;
}

}  // namespace choreo
