#include "model/draw/framing.h"

#include <algorithm>
#include <cmath>

#include "model/body/doll.h"

namespace choreo {
namespace {

constexpr double kBelow = 0.22;  // metres of floor under the dancer's feet
constexpr double kAir = 1.08;

}  // namespace

double FitExtent(const Skeleton& skeleton, const std::vector<FramedPose>& poses, double aspect) {
  const std::vector<DollPart> doll = MakeDoll(skeleton);
  double top = 1.8, side = 0.5;
  for (const FramedPose& framed : poses) {
    for (const PlacedPart& part : PlaceDoll(doll, ForwardKinematics(skeleton, *framed.pose))) {
      for (const auto& [ball, radius] : {std::pair(part.shape.a, part.shape.radius_a),
                                         std::pair(part.shape.b, part.shape.radius_b)}) {
        top = std::max(top, double{ball.y()} + radius);
        side = std::max(side, std::hypot(ball.x() - framed.x, ball.z() - framed.z) + radius);
      }
    }
  }
  return std::clamp(kAir * std::max(top + kBelow, 2 * side / aspect), 2.0, 4.0);
}

View StandingView(const FramedPose& framed, double azimuth, double extent) {
  View view;
  view.target = {framed.x, extent / 2 - kBelow, framed.z};
  view.azimuth = azimuth;
  view.extent = extent;
  return view;
}

}  // namespace choreo
