#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "model/formats/arrays/amass_npz.h"
#include "model/formats/arrays/own_arrays.h"
#include "tests/fuzz/fuzz.h"

namespace choreo {
namespace {

// Behind an archive's checksums, which no mutation gets past: what the arrays of a motion may be.
constexpr std::array kKeys = {"root_positions",
                              "rotations",
                              "fps",
                              "poses",
                              "trans",
                              "smpl_poses",
                              "smpl_trans",
                              "smpl_scaling",
                              "mocap_framerate",
                              "root_orient",
                              "pose_body",
                              "global_orient",
                              "body_pose",
                              "transl",
                              "betas",
                              "jaw_pose",
                              "joints",
                              "pose_world",
                              "trans_world",
                              "q",
                              "pos",
                              "scale"};
constexpr std::array<int64_t, 19> kExtents = {0, 1, 2,  3,  24,  25,  72, 156, 165, 4,
                                              6, 9, 21, 63, 144, 216, 22, 88,  96};

NpyArray MakeArray(fuzz::Decisions& decisions) {
  NpyArray array;
  int64_t count = 1;
  for (int left = decisions.Byte() % 4; left > 0; --left) {
    array.shape.push_back(kExtents[decisions.Byte() % kExtents.size()]);
    count *= array.shape.back();
  }
  if (count > 50'000) return {};
  std::vector<double> values(static_cast<size_t>(count), 0.1);
  // One value, drawn bit by bit, stands somewhere.
  double drawn = 0;
  const auto bits = decisions.Take(sizeof(drawn));
  std::memcpy(&drawn, bits.data(), bits.size());
  if (count > 0) values[static_cast<size_t>(decisions.Below(1 << 16) % count)] = drawn;
  array.values = std::move(values);
  return array;
}

}  // namespace
}  // namespace choreo

FUZZ_TARGET(motion_arrays) {
  using namespace choreo;
  fuzz::Decisions decisions(data, size);
  fuzz::MayRefuse([&] {
    NpzArchive npz;
    while (!decisions.over()) {
      const char* key = kKeys[decisions.Byte() % kKeys.size()];
      npz.SetArray(key, MakeArray(decisions));
    }
    ReadSmplMotion(npz);
  });
  return 0;
}
