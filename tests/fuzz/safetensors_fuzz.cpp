#include "model/core/files/safetensors.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(safetensors) {
  using namespace choreo;
  static const fuzz::InputFile input(".safetensors");
  fuzz::MayRefuse([&] {
    const auto& path = input.Holding(fuzz::Text(data, size));
    const Safetensors read = ReadSafetensors(path);
    WriteSafetensors(path, read);
    if (ContentHash(ReadSafetensors(path)) != ContentHash(read))
      fuzz::Fail("what was read can't be written");
  });
  return 0;
}
