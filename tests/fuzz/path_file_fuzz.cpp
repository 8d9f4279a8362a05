#include "client/authoring/controls/written_controls.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace choreo;
  fuzz::MayRefuse([&] { authoring::ParsePathFile(fuzz::Text(data, size), "path.json", 30); });
  return 0;
}
