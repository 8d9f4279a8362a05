#include "model/engine/flow_tile.h"

#include <algorithm>

#include "model/core/random.h"

namespace choreo {

void FrameNoise::Fill(std::span<float> out) const {
  if (spread == 0) {
    std::ranges::fill(out, 0.0F);
    return;
  }
  FillNormal(seed, candidate, frame, out);
  for (float& value : out) value *= spread;
}

}  // namespace choreo
