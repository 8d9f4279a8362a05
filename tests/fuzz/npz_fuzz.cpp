#include "model/formats/motion_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(npz) {
  using namespace choreo;
  static const fuzz::InputFile input(".npz");
  fuzz::MayRefuse([&] { ReadMotion(input.Holding(fuzz::Text(data, size))); });
  return 0;
}
