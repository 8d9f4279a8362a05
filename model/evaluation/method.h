#pragma once

#include <string>
#include <vector>

#include "model/engine/step_engine.h"

namespace choreo {

/// A row of a table: who makes the transitions.
struct Method {
  enum class Kind {
    kReal,           ///< what was really danced
    kInterpolation,  ///< lerp and slerp between last pose and key, as they are
    kEngine,         ///< an engine, through model/dance as the server has it
  };
  std::string name;
  Kind kind = Kind::kEngine;
  StepEngine* engine = nullptr;  ///< of kEngine; not owned
  bool keys = true;              ///< kEngine: false for a dance to the music alone
  bool network = true;  ///< kEngine: false where there is none to be looked at without arrival and
                        ///< foot lock
};

inline const char* const kServed = "model";  ///< the method that is judged, in every table

/// What one evaluation does alike in all its rows.
struct EvalOptions {
  std::vector<int> lengths = {10, 30, 60, 90};  ///< frames of the transitions
  int windows_per_clip = 8;
  int best_of = 10;  ///< samples a window at temperature 1; 0: none
  float temperature = 0;
  int long_seeds = 50;       ///< long dances of each kind; 0: none
  int long_frames = 1800;    ///< 60 s
  int free_dances = 20;      ///< without keys, of the table of liveliness; 0: none
  bool all_controls = true;  ///< false: of the tables of controls, paper C's alone
};

}  // namespace choreo
