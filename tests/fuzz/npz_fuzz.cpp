#include "model/formats/motion_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace choreo;
  static const fuzz::InputFile input(".npz");
  fuzz::MayRefuse([&] { ReadMotion(input.Holding(fuzz::Text(data, size))); });
  return 0;
}
