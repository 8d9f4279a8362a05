#include "model/motion/skeleton_json.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(skeleton) {
  using namespace choreo;
  fuzz::MayRefuse([&] {
    const Skeleton skeleton = SkeletonFromJson(std::string(fuzz::Text(data, size)));
    SkeletonFromJson(SkeletonToJson(skeleton));
  });
  return 0;
}
