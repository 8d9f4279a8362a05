#include "model/training/prepare/beat_grid.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "model/core/error.h"

namespace choreo {

BeatGrid Skip(BeatGrid grid, double skipped_s) {
  const double bar_s = grid.period_s * grid.per_bar;
  const double first = grid.offset_s - skipped_s;
  grid.offset_s = first - bar_s * std::floor(first / bar_s);
  return grid;
}

double SpeedPowerAt(const PositionClip& clip, double period_s) {
  CheckClip(clip);
  const auto steps = static_cast<Eigen::Index>(clip.frames.size()) - 1;
  if (steps < 2) throw InvalidArgument("frames", std::to_string(steps + 1) + ", must be 3 or more");
  Eigen::ArrayXd speed(steps);
  for (Eigen::Index k = 0; k < steps; ++k)
    speed[k] = (clip.frames[k + 1] - clip.frames[k]).colwise().norm().mean();
  // The window keeps slow changes from leaking into other periods.
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(steps, 0.5, steps - 0.5);
  const Eigen::ArrayXd window = 0.5 - 0.5 * (2 * std::numbers::pi / steps * time).cos();
  const Eigen::ArrayXd change = (speed - speed.mean()) * window;
  const double power = change.square().sum();
  if (!(power > 0)) return 0;
  const Eigen::ArrayXd angle = 2 * std::numbers::pi / (period_s * clip.fps) * time;
  const double at =
      std::norm(std::complex<double>((change * angle.cos()).sum(), (change * angle.sin()).sum()));
  // A sine of this period alone gives 1.
  return 2 * at * window.square().sum() / (power * window.sum() * window.sum());
}

}  // namespace choreo
