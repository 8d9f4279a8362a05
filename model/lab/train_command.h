#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace choreo {

/// Adds the command `choreo-lab train`. `read_device` parses --device ("cpu", "cuda:N") and throws
/// Error for a device that does not exist.
void AddTrainCommand(CLI::App& app,
                     const std::function<std::string(const std::string&)>& read_device);

}  // namespace choreo
