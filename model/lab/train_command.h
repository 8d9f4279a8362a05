#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab train`. `read_device`: the device ("cpu", "cuda:N") that the text of --device stands
/// for; throws Error for one that is not there.
void AddTrainCommand(CLI::App& app,
                     const std::function<std::string(const std::string&)>& read_device);

}  // namespace choreo
