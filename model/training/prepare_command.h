#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab prepare`.
void AddPrepareCommand(CLI::App& app);

}  // namespace choreo
