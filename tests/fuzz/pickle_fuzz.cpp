#include "model/formats/containers/pickle.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace choreo;
  fuzz::MayRefuse([&] { ParsePickledArrays(fuzz::Text(data, size), "a.pkl"); });
  return 0;
}
