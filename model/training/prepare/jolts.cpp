#include "model/training/prepare/jolts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kSpeed = 11;    // m/s of a joint between frames
constexpr int kMaxSteps = 3;     // consecutive fast steps of a jolt; more are a real swing
constexpr double kContrast = 2;  // a jolt is this many times faster than the steps around it
constexpr double kBridge = 0.1;  // s interpolated before and after a jolt
constexpr double kMaxBridgeSeconds = 0.8;  // s; longer bridges are not made

using Span = std::pair<int, int>;  // first, last frame to interpolate

// The joint at which each joint's limb begins; -1 for the trunk between branching joints.
std::vector<int> LimbOfJoint(const Skeleton& skeleton) {
  std::vector<int> children(skeleton.joints(), 0);
  std::vector<bool> trunk(skeleton.joints(), false);
  for (int joint = skeleton.joints() - 1; joint > 0; --joint) {  // children before their parents
    const int parent = skeleton.parents[joint];
    ++children[parent];
    if (children[joint] >= 3) trunk[joint] = true;
    if (trunk[joint]) trunk[parent] = true;
  }
  std::vector<int> limb(skeleton.joints(), -1);
  for (int joint = 1; joint < skeleton.joints(); ++joint) {
    const int parent = skeleton.parents[joint];
    if (!trunk[joint]) limb[joint] = limb[parent] >= 0 ? limb[parent] : joint;
  }
  return limb;
}

// Steps f - 1 → f in which a limb snaps, as spans of steps.
std::vector<Span> FindJolts(const std::vector<double>& speeds) {
  std::vector<Span> jolts;
  const auto count = static_cast<int>(speeds.size());
  for (int first = 1; first < count; ++first) {
    if (speeds[first] <= kSpeed) continue;
    int last = first;
    double top = speeds[first];
    while (last + 1 < count && speeds[last + 1] > kSpeed) top = std::max(top, speeds[++last]);
    const double before = first > 1 ? speeds[first - 1] : 0;
    const double after = last + 1 < count ? speeds[last + 1] : 0;
    if (last - first < kMaxSteps && top > kContrast * std::min(before, after)) {
      jolts.emplace_back(first, last);
    }
    first = last;
  }
  return jolts;
}

// Jolts as spans of frames to interpolate, each with a margin, merged if they touch.
std::vector<Span> MergeWithMargin(const std::vector<Span>& jolts, int margin) {
  std::vector<Span> spans;
  for (const auto& [first, last] : jolts) {
    const Span span(first - margin, last - 1 + margin);
    if (!spans.empty() && span.first <= spans.back().second + 1) {
      spans.back().second = std::max(spans.back().second, span.second);
    } else {
      spans.push_back(span);
    }
  }
  return spans;
}

// Jolts by limb and of the body.
struct Jolts {
  std::vector<int> limb_of;                // [joints]
  std::vector<std::vector<Span>> of_limb;  // [joints] steps, at the limbs' first joints
  std::vector<Span> of_body;               // steps
};

Jolts FindAllJolts(const Skeleton& skeleton, const Motion& motion) {
  const auto frames = static_cast<int>(motion.frames.size());
  Jolts jolts;
  jolts.limb_of = LimbOfJoint(skeleton);
  std::vector<std::vector<double>> speeds(skeleton.joints(), std::vector<double>(frames, 0.0));
  Eigen::Matrix3Xd previous;
  for (int frame = 0; frame < frames; ++frame) {
    Eigen::Matrix3Xd positions = JointPositions(skeleton, motion.frames[frame]);
    positions.colwise() -= positions.col(0).eval();
    for (int joint = 1; frame > 0 && joint < skeleton.joints(); ++joint) {
      double& speed = speeds[std::max(0, jolts.limb_of[joint])][frame];
      speed = std::max(speed, (positions.col(joint) - previous.col(joint)).norm() * motion.fps);
    }
    previous = std::move(positions);
  }
  constexpr int kBody = 2;  // limbs
  std::vector<int> parts(frames, 0);
  jolts.of_limb.resize(skeleton.joints());
  for (int part = 0; part < skeleton.joints(); ++part) {  // 0 stands for the trunk
    jolts.of_limb[part] = FindJolts(speeds[part]);
    for (const auto& [first, last] : jolts.of_limb[part]) {
      for (int step = first; step <= last; ++step) parts[step] += part == 0 ? kBody : 1;
    }
  }
  for (std::vector<Span>& of_limb : jolts.of_limb) {
    std::erase_if(of_limb, [&](const Span& jolt) {
      const bool body = std::any_of(parts.begin() + jolt.first, parts.begin() + jolt.second + 1,
                                    [](int count) { return count >= kBody; });
      if (body) jolts.of_body.push_back(jolt);
      return body;
    });
  }
  return jolts;
}

int Margin(const Motion& motion) {
  return std::max(1, static_cast<int>(std::lround(kBridge * motion.fps)));
}

}  // namespace

std::vector<int> FindBreaks(const Skeleton& skeleton, const Motion& motion) {
  const auto frames = static_cast<int>(motion.frames.size());
  const int margin = Margin(motion);
  const Jolts jolts = FindAllJolts(skeleton, motion);
  std::vector<int> breaks;
  const auto cut = [&](const Span& jolt) {
    for (int step = jolt.first; step <= jolt.second; ++step) breaks.push_back(step);
  };
  for (const Span& jolt : jolts.of_body) cut(jolt);
  for (const std::vector<Span>& of_limb : jolts.of_limb) {
    for (const Span& jolt : of_limb) {
      if (jolt.first - margin < 1 || jolt.second + margin >= frames) cut(jolt);
    }
  }
  std::ranges::sort(breaks);
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

LimbRepair RepairLimbs(const Skeleton& skeleton, Motion& motion) {
  LimbRepair result;
  const auto frames = static_cast<int>(motion.frames.size());
  const Jolts jolts = FindAllJolts(skeleton, motion);
  for (int limb = 1; limb < skeleton.joints(); ++limb) {
    for (const auto& [first, last] : MergeWithMargin(jolts.of_limb[limb], Margin(motion))) {
      if (first < 1 || last + 1 >= frames || (last - first + 1) / motion.fps > kMaxBridgeSeconds) {
        ++result.left;
        continue;
      }
      const Pose& from = motion.frames[first - 1];
      const Pose& to = motion.frames[last + 1];
      for (int frame = first; frame <= last; ++frame) {
        const double time = static_cast<double>(frame - first + 1) / (last - first + 2);
        const double eased = SmoothStep(time);
        for (int joint = limb; joint < skeleton.joints(); ++joint) {
          if (jolts.limb_of[joint] != limb) continue;
          motion.frames[frame].rotations.col(joint) =
              Slerp(from.rotations.col(joint), to.rotations.col(joint), eased);
        }
      }
      result.frames += last - first + 1;
    }
  }
  if (result.frames > 0) MakeContinuous(motion);
  return result;
}

}  // namespace choreo
