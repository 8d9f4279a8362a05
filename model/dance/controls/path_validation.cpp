#include "model/dance/controls/path_validation.h"

#include <cmath>

#include "model/core/error.h"
#include "model/dance/timeline/validation.h"
#include "model/motion/pose/pose_limits.h"

namespace choreo {

void CheckPath(const RootPath& path, const std::string& field) {
  CheckFrames(path.frames, field + ".frames");
  const size_t count = path.points.size(), frames = path.frames.size();
  const size_t heights = path.heights.size();
  if (count != frames) {
    throw InvalidArgument(field + ".points", std::to_string(count) + " points for " +
                                                 std::to_string(frames) + " frames");
  }
  if (heights != 0 && heights != count) {
    throw InvalidArgument(field + ".heights", std::to_string(heights) + " heights for " +
                                                  std::to_string(count) + " points");
  }
  if (count < 2) {
    throw InvalidArgument(field + ".points",
                          std::to_string(count) + " points, a path needs at least 2");
  }
  for (size_t i = 0; i < count; ++i) {
    // Written so that NaN fails too.
    for (const int axis : {0, 1}) {
      const double value = path.points[i][axis];
      if (std::abs(value) <= kMaxPosition) continue;
      throw InvalidArgument(At(field + ".points", static_cast<int64_t>(2 * i) + axis),
                            Show(value) + " m is not within " + Show(kMaxPosition) + " m of 0");
    }
    if (heights != 0 && !(path.heights[i] >= 0 && path.heights[i] <= kMaxRootHeight)) {
      throw InvalidArgument(
          At(field + ".heights", static_cast<int64_t>(i)),
          Show(path.heights[i]) + " m above the floor is not in [0, " + Show(kMaxRootHeight) + "]");
    }
  }
}

}  // namespace choreo
