#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab study make` writes a blinded page on which people rank dances (study.h), `choreo-lab
/// study score` prints what they answered.
void AddStudyCommand(CLI::App& app);

}  // namespace choreo
