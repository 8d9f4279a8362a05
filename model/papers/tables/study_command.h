#pragma once

namespace CLI {
class App;
}

namespace choreo {

/// `choreo-lab study dance` films what models dance, `study make` writes a blinded page on which
/// people rank films (study.h), and `study score` prints what they answered.
void AddStudyCommand(CLI::App& app);

}  // namespace choreo
