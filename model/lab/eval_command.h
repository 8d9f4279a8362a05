#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab eval`.
void AddEvalCommand(CLI::App& app);

}  // namespace choreo
