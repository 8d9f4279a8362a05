#include "model/motion/skeleton_json.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace choreo;
  fuzz::MayRefuse([&] {
    const Skeleton skeleton = SkeletonFromJson(std::string(fuzz::Text(data, size)));
    SkeletonFromJson(SkeletonToJson(skeleton));
  });
  return 0;
}
