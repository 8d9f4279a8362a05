#include "model/engine/engine_choice.h"

#include <algorithm>
#include <charconv>
#include <span>

#include "model/core/error.h"

namespace choreo {
namespace {

std::string Describe(const AvailableDevices& available) {
  if (!available.cuda_build) return "this build has no CUDA, only: cpu";
  std::string list = "cpu";
  for (int i = 0; i < available.cuda_devices; ++i) list += ", cuda:" + std::to_string(i);
  return (available.cuda_devices == 0 ? "no CUDA device answers, there is only: " : "there are: ") +
         list;
}

std::string Listed(std::span<const std::string_view> names) {
  std::string all;
  for (const std::string_view name : names) {
    if (!all.empty()) all += ", ";
    all += name;
  }
  return all;
}

}  // namespace

std::string Device::name() const {
  return kind == Kind::kCpu ? "cpu" : "cuda:" + std::to_string(index);
}

std::vector<Device> ParseDevices(std::string_view text, const AvailableDevices& available,
                                 const std::string& field) {
  std::vector<Device> devices;
  if (text == "cpu") return {Device{}};
  if (text == "auto") {
    for (int i = 0; i < available.cuda_devices; ++i) devices.push_back({Device::Kind::kCuda, i});
    return devices.empty() ? std::vector{Device{}} : devices;
  }
  constexpr std::string_view kPrefix = "cuda:";
  std::string_view rest = text.starts_with(kPrefix) ? text.substr(kPrefix.size()) : "";
  for (;;) {
    Device device{Device::Kind::kCuda, -1};
    const char* begin = rest.data();
    const auto [end, error] = std::from_chars(begin, begin + rest.size(), device.index);
    rest.remove_prefix(static_cast<size_t>(end - begin));
    if (error != std::errc() || device.index < 0 || (!rest.empty() && rest.front() != ',')) {
      throw InvalidArgument(field,
                            "'" + std::string(text) + "' is not one of auto, cpu, cuda:N[,M...]");
    }
    if (std::ranges::count(devices, device) > 0)
      throw InvalidArgument(field, device.name() + " is named twice");
    if (!available.cuda_build || device.index >= available.cuda_devices) {
      throw Error(ErrorCode::kNotFound, field,
                  device.name() + " was asked for, but " + Describe(available));
    }
    devices.push_back(device);
    if (rest.empty()) return devices;
    rest.remove_prefix(1);
  }
}

std::string EngineKindNames() { return Listed(kEngineKindNames); }

std::string KernelNames() { return Listed(kKernelNames); }

EngineKind ParseEngineKind(std::string_view text, const std::string& field) {
  const auto name = std::ranges::find(kEngineKindNames, text);
  if (name == kEngineKindNames.end()) {
    throw InvalidArgument(field, "\"" + std::string(text) + "\" is none of " + EngineKindNames());
  }
  return static_cast<EngineKind>(name - kEngineKindNames.begin());
}

}  // namespace choreo
