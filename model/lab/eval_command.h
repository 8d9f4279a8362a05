#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// Adds the command `choreo-lab eval`.
void AddEvalCommand(CLI::App& app);

}  // namespace choreo
