#include "model/motion/foot_slides.h"

#include <cmath>
#include <limits>
#include <utility>

#include "model/motion/contacts.h"
#include "model/motion/floor_clearance.h"

namespace choreo {

SlideWatch::SlideWatch(const Skeleton& skeleton, double fps)
    : fps_(fps),
      toes_{skeleton.feet[1], skeleton.feet[3]},
      low_{},
      touch_(FloorClearance(skeleton).array() + kUpHeight) {
  for (size_t foot = 0; foot < 2; ++foot)
    low_[foot] = FloorClearance(skeleton)[toes_[foot]] + kSlideHeight;
  for (const int joint : skeleton.feet)
    if (joint >= 0) touch_[joint] = -std::numeric_limits<double>::infinity();
}

void SlideWatch::Add(int64_t frame, const Eigen::Matrix3Xd& earlier,
                     const Eigen::Matrix3Xd& later) {
  const Eigen::RowVectorXd heights = earlier.row(1).cwiseMax(later.row(1));
  const bool lies = (heights - touch_).minCoeff() < 0;
  for (size_t foot = 0; foot < 2; ++foot) {
    FootSlide& slide = under_way_[foot];
    const Eigen::Vector3d step = later.col(toes_[foot]) - earlier.col(toes_[foot]);
    const double metres = std::hypot(step.x(), step.z());
    if (lies || heights[toes_[foot]] > low_[foot] || metres * fps_ <= kSlideSpeed) {
      End(&slide);
      continue;
    }
    if (slide.metres == 0) slide.first = frame - 1;
    slide.toes = toes_[foot];
    slide.last = frame;
    slide.metres += metres;
  }
}

void SlideWatch::End() {
  for (FootSlide& slide : under_way_) End(&slide);
}

void SlideWatch::End(FootSlide* slide) {
  const FootSlide ended = std::exchange(*slide, {});
  if (ended.metres >= kLeastSlide) ended_.push_back(ended);
}

std::vector<FootSlide> SlideWatch::Take() { return std::exchange(ended_, {}); }

}  // namespace choreo
