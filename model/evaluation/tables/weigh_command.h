#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// Adds `choreo-lab weigh DATA...`, which prints how prepared clips stand on their floor, clip by
/// clip and averaged over each set. A model learns to hover from clips that hover.
void AddWeighCommand(CLI::App& app);

}  // namespace choreo
