#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab weigh DATA...`: prints how prepared clips stand on their floor, clip by clip and
/// averaged over each set, because a model learns to hover from clips that hover.
void AddWeighCommand(CLI::App& app);

}  // namespace choreo
