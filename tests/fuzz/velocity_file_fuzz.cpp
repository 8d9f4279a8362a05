#include "client/authoring/controls/velocities.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(velocity_file) {
  using namespace choreo;
  static const fuzz::InputFile input(".json");
  const std::string text(fuzz::Text(data, size));
  fuzz::MayRefuse([&] { authoring::ReadVelocities({input.Holding(text).string()}, "median", 30); });
  // What stands on a command line: PART=VALUE.
  if (!authoring::IsVelocityFile(text))
    fuzz::MayRefuse([&] { authoring::ReadVelocities({text}, "", 30); });
  return 0;
}
