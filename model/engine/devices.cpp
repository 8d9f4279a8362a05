#include "model/engine/devices.h"

#include <algorithm>
#include <charconv>

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

int ParseIndex(std::string_view text, std::string_view whole, const std::string& field) {
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || index < 0) {
    throw InvalidArgument(field,
                          "'" + std::string(whole) + "' is not one of auto, cpu, cuda:N[,M...]");
  }
  return index;
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
    const size_t comma = rest.find(',');
    const Device device{Device::Kind::kCuda, ParseIndex(rest.substr(0, comma), text, field)};
    if (std::find(devices.begin(), devices.end(), device) != devices.end()) {
      throw InvalidArgument(field, device.name() + " is named twice");
    }
    if (!available.cuda_build || device.index >= available.cuda_devices) {
      throw Error(ErrorCode::kNotFound, field,
                  device.name() + " was asked for, but " + Describe(available));
    }
    devices.push_back(device);
    if (comma == std::string_view::npos) return devices;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace choreo
