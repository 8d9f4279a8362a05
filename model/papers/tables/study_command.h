#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab study dance` films models' dances, `study make` writes a blinded page on which
/// people rank films (study.h), and `study score` prints the results.
void AddStudyCommand(CLI::App& app);

}  // namespace choreo
