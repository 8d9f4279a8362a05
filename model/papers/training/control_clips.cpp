#include "model/papers/training/control_clips.h"

#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "model/core/numbers/quantile.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/pose/facing_pose.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

using torch::Tensor;

constexpr double kControlTempi[] = {1.0, 0.75, 1.33};
constexpr double kHandSmoothness = 9;  // frames: the smoothness of a drawn path
constexpr double kMinScale = 0.5, kMaxScale = 1.5;
constexpr float kScaledWeight = 0.15F;  // weight of real motion if factors are scaled

// Smooths x [..., time, features] in time with a Gaussian of `sigma` frames, normalised at the
// ends.
Tensor SmoothInTime(const Tensor& x, double sigma) {
  const Tensor at = torch::arange(x.size(-2), x.options());
  const Tensor apart = (at.unsqueeze(0) - at.unsqueeze(1)) / sigma;
  return torch::matmul(torch::softmax(-0.5 * apart.square(), 1), x);
}

// Smooths the path [N, 3], which starts from `before` [3], and keeps its ends.
Tensor DrawnPath(const Tensor& path, const Tensor& before) {
  const Tensor all = torch::cat({before.unsqueeze(0), path}, 0);
  const int64_t last = all.size(0) - 1;
  const Tensor blurred = SmoothInTime(all, kHandSmoothness);
  const Tensor u = torch::arange(last + 1, all.options()).unsqueeze(1) / static_cast<double>(last);
  const Tensor mended = blurred + (1 - u) * (all[0] - blurred[0]) + u * (all[last] - blurred[last]);
  return mended.narrow(0, 1, last);
}

// Factors of the body parts' velocity factors, half of the time equal for all parts.
Tensor DrawnScales(Random* random) {
  std::vector<float> scales(kBodyParts);
  const bool alike = random->Uniform() < 0.5;
  for (size_t part = 0; part < scales.size(); ++part) {
    scales[part] =
        alike && part > 0 ? scales[0] : static_cast<float>(random->Uniform(kMinScale, kMaxScale));
  }
  return torch::tensor(scales);
}

}  // namespace

ControlClips::ControlClips(const std::vector<PreparedClip>& clips)
    : skeleton_(clips.front().skeleton), clips_(clips.size()), tempi_(std::size(kControlTempi)) {
  for (const PreparedClip& clip : clips) {
    for (const double tempo : kControlTempi) {
      for (const bool mirrored : {false, true}) tracks_.push_back(MakeTrack(clip, tempo, mirrored));
    }
  }
}

ControlClips::Track ControlClips::MakeTrack(const PreparedClip& clip, double tempo,
                                            bool mirrored) const {
  const BodyPartWeights weights = WeighBodyParts(skeleton_);
  const std::vector<int> pairs = MirrorPairs(skeleton_);
  const auto& frames = clip.motion.frames;
  Track track;
  Eigen::Matrix3Xd before;
  double heading = 0;
  for (;; ++track.frames) {
    const double at = static_cast<double>(track.frames) * tempo;
    const auto first = static_cast<size_t>(at);
    if (first + 1 >= frames.size()) break;
    Pose pose =
        tempo == 1 ? frames[first] : InterpolatePoses(frames[first], frames[first + 1], at - first);
    if (mirrored) pose = Mirror(pairs, pose);
    FacingPose facing = FacingOf(skeleton_, pose);
    if (track.frames > 0) facing.heading = NearestTurn(facing.heading, heading);
    heading = facing.heading;
    const Eigen::Matrix3Xd positions = PositionsOf(facing);
    if (track.frames == 0) before = positions;
    const auto factors = PartSpeeds(weights, before, positions);
    before = positions;
    const auto append = [](std::vector<float>* to, const auto& values) {
      std::transform(values.begin(), values.end(), std::back_inserter(*to),
                     [](double value) { return static_cast<float>(value); });
    };
    append(&track.root, facing.root);
    track.heading.push_back(static_cast<float>(facing.heading));
    append(&track.joints, facing.joints.reshaped());
    append(&track.factors, factors);
    for (int foot = 0; foot < 4; ++foot) {
      // Contacts are left, then right; mirroring swaps them.
      track.contacts.push_back(clip.contacts(mirrored ? (foot + 2) % 4 : foot, first));
    }
  }
  return track;
}

int64_t ControlClips::Longest() const {
  int64_t longest = 0;
  for (size_t clip = 0; clip < clips_; ++clip)
    longest = std::max(longest, At(clip, 0, false).frames - 1);
  return longest;
}

std::array<double, kBodyParts> ControlClips::MedianFactors() const {
  std::array<double, kBodyParts> medians;
  for (size_t part = 0; part < medians.size(); ++part) {
    std::vector<float> values;
    for (size_t clip = 0; clip < clips_; ++clip) {
      const Track& track = At(clip, 0, false);
      for (size_t i = part; i < track.factors.size(); i += kBodyParts)
        values.push_back(track.factors[i]);
    }
    medians[part] = Median(std::move(values));
  }
  return medians;
}

ControlClips::Place ControlClips::DrawPlace(const WindowPicker& picker, int window,
                                            const Variation& variation, Random* random) const {
  auto [clip, start] = picker.Draw(random);
  size_t tempo = 0;
  if (random->Uniform() < variation.tempo) {
    const auto other = static_cast<size_t>(random->Integer(1, static_cast<int64_t>(tempi_)));
    const int64_t offered = std::max<int64_t>(0, At(clip, other, false).frames - window);
    if (offered > 0) {
      tempo = other;
      start = random->Integer(0, offered) + 1;
    }
  }
  return {At(clip, tempo, random->Uniform() < variation.mirror), start};
}

ControlBatch ControlClips::Draw(int batch, int history, int frames, const Variation& variation,
                                Random* random) const {
  const int window = history + frames;
  std::vector<int64_t> clips;
  for (size_t clip = 0; clip < clips_; ++clip) clips.push_back(At(clip, 0, false).frames);
  const WindowPicker picker(clips, window);
  const int others = skeleton_.joints() - 1;
  Tensor root = torch::empty({batch, window, 3}), heading = torch::empty({batch, window});
  Tensor joints = torch::empty({batch, window, others, 3});
  Tensor contacts = torch::empty({batch, window, 4});
  Tensor factors = torch::empty({batch, window, kBodyParts});
  Tensor has_target = torch::ones({batch, 1}), weight = torch::ones({batch});
  Tensor turn = torch::empty({batch});
  std::vector<Tensor> paths, given, expected;
  for (int b = 0; b < batch; ++b) {
    const Place place = DrawPlace(picker, window, variation, random);
    const Track& track = place.track;
    const auto copy = [&](const std::vector<float>& from, const Tensor& to, int64_t width) {
      std::copy_n(from.data() + place.start * width, window * width, to[b].data_ptr<float>());
    };
    copy(track.root, root, 3);
    copy(track.heading, heading, 1);
    copy(track.joints, joints, 3 * others);
    copy(track.contacts, contacts, 4);
    copy(track.factors, factors, kBodyParts);

    // Moves it into the canonical frame of the last history frame.
    const Tensor at = root[b][history - 1].clone();
    const Tensor origin = at * torch::tensor({1.0F, 0.0F, 1.0F});
    const Tensor first = heading[b][history - 1].clone();
    heading[b] -= first;
    root[b] = TurnBack(root[b] - origin, HeadingOf(first));
    turn[b] = static_cast<float>(NearestTurn(heading[b][window - 1].item<double>(), 0));

    if (random->Uniform() < variation.no_target) has_target[b] = 0;
    Tensor path = root[b].narrow(0, history, frames);
    if (random->Uniform() < variation.smooth_path) path = DrawnPath(path, root[b][history - 1]);
    paths.push_back(path);
    Tensor real = factors[b].narrow(0, history, frames), control = real;
    if (random->Uniform() < variation.smooth_factors)
      control = SmoothInTime(real, std::exp(random->Uniform(std::log(5), std::log(200))));
    if (random->Uniform() < variation.scale_factors) {
      const Tensor scales = DrawnScales(random);
      control = control * scales;
      real = real * scales;
      weight[b] = kScaledWeight;
    }
    given.push_back(control);
    expected.push_back(real);
  }
  const FrameTensors all{root, HeadingOf(heading), joints, contacts};
  return {.transition = {frames, all.Narrow(0, history), joints.select(1, window - 1), turn,
                         has_target, torch::stack(paths), torch::stack(given)},
          .truth = all.Narrow(history, frames),
          .factors = torch::stack(expected),
          .weight = weight};
}

}  // namespace choreo
