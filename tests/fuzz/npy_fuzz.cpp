#include "model/core/npy.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace choreo;
  fuzz::MayRefuse([&] {
    const NpyArray array = ParseNpy(std::as_bytes(std::span(data, size)), "a.npy");
    const std::string written = SerializeNpy(array);
    if (ParseNpy(std::as_bytes(std::span(written)), "b.npy").shape != array.shape)
      fuzz::Fail("what was read can't be written");
  });
  return 0;
}
