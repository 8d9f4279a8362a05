#include "model/formats/motion_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

// A dict that numpy.save wrote, or joints' places.
FUZZ_TARGET(motion_npy) {
  using namespace choreo;
  static const fuzz::InputFile input(".npy");
  fuzz::MayRefuse([&] { ReadMotion(input.Holding(fuzz::Text(data, size))); });
  return 0;
}
