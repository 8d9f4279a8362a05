#include "client/authoring/controls/written_controls.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(path_file) {
  using namespace choreo;
  fuzz::MayRefuse([&] { authoring::ParsePathFile(fuzz::Text(data, size), "path.json", 30); });
  return 0;
}
