#include "model/dance/delivery/output_rate.h"

#include <cmath>
#include <utility>

#include "model/motion/resample.h"

namespace choreo {

OutputRate::OutputRate(double model_fps, double output_fps, int64_t first_frame,
                       std::optional<Pose> before)
    : model_fps_(model_fps), output_fps_(output_fps), next_input_(first_frame) {
  if (first_frame == 0) return;
  // The first output frame after the preceding model frame; earlier ones belong to the part before
  // the resume.
  const double before_at = static_cast<double>(first_frame - 1) * output_fps_ / model_fps_;
  next_output_ = static_cast<int64_t>(std::floor(before_at + kOnFrame)) + 1;
  last_ = std::move(before);
}

OutputFrames OutputRate::Push(const DanceFrame& frame) {
  OutputFrames out;
  out.first_frame = next_output_;
  const double now = static_cast<double>(next_input_);
  for (;; ++next_output_) {
    const double at = static_cast<double>(next_output_) * model_fps_ / output_fps_;
    if (at > now + kOnFrame) break;
    out.contacts.push_back(frame.contacts);
    if (at >= now - kOnFrame || !last_) {
      out.poses.push_back(frame.pose);
      continue;
    }
    const double t = at - (now - 1);
    out.poses.push_back(RoundToFloat(KeepSigns(InterpolatePoses(*last_, frame.pose, t), *last_)));
  }
  last_ = frame.pose;
  ++next_input_;
  return out;
}

}  // namespace choreo
