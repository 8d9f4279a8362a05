#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab weigh DATA...`: prints how prepared clips stand on their floor, clip by clip and the
/// means of each set: whoever hovers there teaches it.
void AddWeighCommand(CLI::App& app);

}  // namespace choreo
