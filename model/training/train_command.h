#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace choreo {

/// The device ("cpu", "cuda:N") that the text of --device stands for; throws Error for one that is
/// not there.
using DeviceReader = std::function<std::string(const std::string&)>;

/// `choreo-lab train`.
void AddTrainCommand(CLI::App& app, const DeviceReader& read_device);

}  // namespace choreo
