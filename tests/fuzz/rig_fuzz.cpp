#include "model/formats/bvh/bvh.h"
#include "model/formats/motion_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

// All steps for a foreign rig: bones by their names, turns, plausibility.
FUZZ_TARGET(rig) {
  using namespace choreo;
  static const fuzz::InputFile input(".bvh");
  fuzz::MayRefuse([&] {
    const std::string_view text = fuzz::Text(data, size);
    // Longer ones take as long as they are.
    if (ParseBvh(text, "a.bvh").frames() > 4) return;
    std::vector<std::string> notes;
    ReadMotion(input.Holding(text), {.notes = &notes});
    for (const std::string& note : notes) {
      if (note.find('\n') != std::string::npos) fuzz::Fail("a note of several lines");
    }
  });
  return 0;
}
