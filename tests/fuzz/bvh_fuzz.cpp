#include "model/formats/bvh/bvh.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(bvh) {
  using namespace choreo;
  fuzz::MayRefuse([&] {
    const BvhFile file = ParseBvh(fuzz::Text(data, size), "a.bvh");
    BvhSkeleton(file);
    if (file.frames() > 0) BvhPositions(file, file.frames() - 1);
    if (ParseBvh(BvhText(file), "b.bvh").frames() != file.frames())
      fuzz::Fail("what was read can't be written");
  });
  return 0;
}
