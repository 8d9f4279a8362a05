#include "model/formats/containers/pickle.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(pickle) {
  using namespace choreo;
  fuzz::MayRefuse([&] { ParsePickledArrays(fuzz::Text(data, size), "a.pkl"); });
  return 0;
}
