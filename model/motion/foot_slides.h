#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "model/motion/skeleton.h"

namespace choreo {

/// Toes on the floor that are faster than this, metres a second, slide.
inline constexpr double kSlideSpeed = 0.2;
/// Toes up to this much higher than at rest, metres, look as if they touched the floor.
inline constexpr double kSlideHeight = 0.02;
/// Shorter slides, in metres, are not told.
inline constexpr double kLeastSlide = 0.1;

/// A stretch in which a foot slides over the floor.
struct FootSlide {
  int toes = -1;                ///< the joint
  int64_t first = 0, last = 0;  ///< frames
  double metres = 0;            ///< the length of the toes' way
};

/// Finds such stretches frame by frame. A body that lies, sits or kneels may drag its feet: there
/// are none while another part of it touches the floor. Not thread-safe.
class SlideWatch {
 public:
  /// `skeleton` must have toes.
  SlideWatch(const Skeleton& skeleton, double fps);

  /// Takes the joint positions of two consecutive frames, [3, joints]. `frame`: the later one's.
  void Add(int64_t frame, const Eigen::Matrix3Xd& earlier, const Eigen::Matrix3Xd& later);
  /// Ends the slides under way, as at the dance's end.
  void End();
  /// Returns the ended slides of at least kLeastSlide since the last call.
  std::vector<FootSlide> Take();

 private:
  void End(FootSlide* slide);

  double fps_;
  std::array<int, 2> toes_;
  std::array<double, 2> low_;                // the height up to which each foot's toes slide
  Eigen::RowVectorXd touch_;                 // that below which each other joint touches the floor
  std::array<FootSlide, 2> under_way_ = {};  // those with metres > 0
  std::vector<FootSlide> ended_;
};

}  // namespace choreo
