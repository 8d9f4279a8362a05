#include "client/authoring/project/dancers.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(dancers) {
  using namespace choreo;
  static const fuzz::InputFile input(".json");
  fuzz::MayRefuse(
      [&] { authoring::ReadDancers(input.Holding(std::string(fuzz::Text(data, size)))); });
  return 0;
}
