#include "client/arrange.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/resample.h"

namespace choreo::client {
namespace {

int64_t Frames(const FinishedDance& dance) { return std::ssize(dance.motion.frames); }

/// Converts a frame to a rate that is `rate` times lower. Rounds down, with a tolerance.
int64_t Before(int64_t frame, double rate) {
  return static_cast<int64_t>(std::floor(static_cast<double>(frame) / rate + kOnFrame));
}
/// Converts a frame to a rate that is `rate` times lower. Rounds up, with a tolerance.
int64_t After(int64_t frame, double rate) {
  return static_cast<int64_t>(std::ceil(static_cast<double>(frame) / rate - kOnFrame));
}

}  // namespace

FinishedDance PartOf(const FinishedDance& dance, int64_t first, int64_t end) {
  if (first < 0 || end <= first || end > Frames(dance)) {
    throw InvalidArgument("dance", "has " + std::to_string(Frames(dance)) + " frames; [" +
                                       std::to_string(first) + ", " + std::to_string(end) +
                                       ") is not a part of it");
  }
  FinishedDance part;
  part.motion.fps = dance.motion.fps;
  const auto& poses = dance.motion.frames;
  part.motion.frames.assign(poses.begin() + first, poses.begin() + end);
  if (!dance.contacts.empty())
    part.contacts.assign(dance.contacts.begin() + first, dance.contacts.begin() + end);
  return part;
}

FinishedDance Mirrored(const Skeleton& skeleton, const FinishedDance& dance) {
  FinishedDance mirrored{Mirror(skeleton, dance.motion), dance.contacts};
  for (Contacts& contacts : mirrored.contacts)  // ankle and toes of one side, then of the other
    std::rotate(contacts.begin(), contacts.begin() + 2, contacts.end());
  return mirrored;
}

FinishedDance AtRate(FinishedDance dance, double fps) {
  if (dance.motion.fps == fps) return dance;
  FinishedDance resampled{Resample(dance.motion, fps), {}};
  for (int64_t frame = 0; !dance.contacts.empty() && frame < Frames(resampled); ++frame) {
    const auto nearest = std::llround(static_cast<double>(frame) / fps * dance.motion.fps);
    resampled.contacts.push_back(
        dance.contacts[static_cast<size_t>(std::min<int64_t>(nearest, Frames(dance) - 1))]);
  }
  return resampled;
}

Motion Moved(Motion motion, const GroundFrame& from, const GroundFrame& to) {
  for (Pose& pose : motion.frames) pose = to.ToWorld(from.ToLocal(pose));
  MakeContinuous(motion);
  return motion;
}

FinishedDance BegunAt(const Pose& pose, FinishedDance dance) {
  const GroundFrame from = GroundFrame::Of(dance.motion.frames.front());
  dance.motion = Moved(std::move(dance.motion), from, GroundFrame::Of(pose));
  return dance;
}

bool BeginsIn(const Skeleton& skeleton, const FinishedDance& dance, const Pose& pose) {
  const PoseError error = ComparePoses(skeleton, dance.motion.frames.front(), pose);
  return error.position_m <= kMaxKeyError_m && error.angle_deg <= kMaxKeyError_deg;
}

FinishedDance Join(FinishedDance first, const FinishedDance& second) {
  if (second.motion.frames.empty()) return first;
  if (first.contacts.empty() || second.contacts.empty()) {
    first.contacts.clear();
  } else {
    first.contacts.insert(first.contacts.end(), second.contacts.begin(), second.contacts.end());
  }
  std::vector<Pose>& poses = first.motion.frames;
  for (Pose pose : second.motion.frames) {
    MakeContinuous(pose, poses.back());
    poses.push_back(std::move(pose));
  }
  return first;
}

EditedDance Join(const Client& client, FinishedDance first, const FinishedDance& second,
                 const EditOptions& options, int64_t gap) {
  const double rate = first.motion.fps / options.model.fps;
  const int64_t last = Frames(first) - 1;
  const int64_t begin = last + After(gap, 1 / rate);
  // Generates all frames between the two dances.
  FinishedDance between = PartOf(first, last, last + 1);
  between.motion.frames.resize(static_cast<size_t>(begin - last) - 1,
                               between.motion.frames.front());
  if (!between.contacts.empty())
    between.contacts.resize(between.motion.frames.size(), between.contacts.front());
  const FinishedDance whole = Join(Join(std::move(first), between), second);
  return DanceAnew(
      client, whole, options,
      {.from = Before(last, rate), .to = After(begin, rate), .to_id = "the second dance"});
}

}  // namespace choreo::client
