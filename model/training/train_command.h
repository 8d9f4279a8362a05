#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab train`.
void AddTrainCommand(CLI::App& app);

}  // namespace choreo
