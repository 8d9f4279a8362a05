#include "model/core/files/npy.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(npy) {
  using namespace choreo;
  fuzz::MayRefuse([&] {
    const NpyArray array = ParseNpy(fuzz::Text(data, size), "a.npy");
    const std::string written = SerializeNpy(array);
    if (ParseNpy(written, "b.npy").shape != array.shape)
      fuzz::Fail("what was read can't be written");
  });
  return 0;
}
