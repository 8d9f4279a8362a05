#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// Adds the commands `choreo-lab study dance`, which films models' dances; `study make`, which
/// writes a blinded page on which people rank films (study.h); and `study score`, which prints the
/// results.
void AddStudyCommand(CLI::App& app);

}  // namespace choreo
