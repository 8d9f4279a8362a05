#include "model/papers/training/motion_batch.h"

#include <torch/types.h>

#include <algorithm>
#include <cmath>

#include "model/audio/signal/mfcc.h"
#include "model/flow/network/torch_kinematics.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/pose/pose_codec.h"
#include "model/motion/resample.h"
#include "model/training/windows/window_picker.h"

namespace choreo {
namespace {

const double kMaxTempoChange = std::log(4.0 / 3);  // faster or slower

// A window of a clip: which of its frames, and how.
struct DrawnWindow {
  int64_t start = 0;
  double rate = 1;  // frames of the clip per frame
  bool mirrored = false;

  // The clip's frame for frame t; frame 0 precedes the window.
  double Source(int t) const { return static_cast<double>(start - 1) + t * rate; }
};

DrawnWindow DrawWindow(int64_t start, int64_t clip_frames, int window,
                       const MotionVariation& variation, Random* random) {
  DrawnWindow drawn{.start = start, .mirrored = variation.mirror && random->Uniform() < 0.5};
  if (random->Uniform() < variation.tempo) {
    const double other = std::exp(random->Uniform(-kMaxTempoChange, kMaxTempoChange));
    const auto taken = static_cast<int64_t>(std::ceil(window * other)) + 1;
    if (const int64_t spare = clip_frames - taken; spare > 0) {
      drawn.rate = other;
      drawn.start = random->Integer(0, spare) + 1;
    }
  }
  return drawn;
}

// The pose before the window, then the window's poses, in the world.
std::vector<Pose> PosesOf(const PreparedClip& clip, const DrawnWindow& drawn, int window) {
  std::vector<Pose> poses;
  for (int t = 0; t <= window; ++t) {
    const double source = drawn.Source(t);
    const auto at = static_cast<size_t>(source);
    const Pose& pose = clip.motion.frames[at];
    poses.push_back(drawn.rate == 1 ? pose
                                    : InterpolatePoses(pose, clip.motion.frames[at + 1],
                                                       source - static_cast<double>(at)));
  }
  if (drawn.mirrored) {
    for (Pose& pose : poses) pose = Mirror(clip.skeleton, pose);
  }
  return poses;
}

Contacts ContactsAt(const PreparedClip& clip, const DrawnWindow& drawn, int t) {
  Contacts contacts;
  for (int foot = 0; foot < 4; ++foot) {
    // Contacts are left, then right; mirroring swaps them.
    contacts[foot] =
        clip.contacts(drawn.mirrored ? (foot + 2) % 4 : foot, std::lround(drawn.Source(t)));
  }
  return contacts;
}

// Masks the key or a part of it. `mask`: ones for each joint and the root position.
void VaryKey(const MotionVariation& variation, Random* random, torch::Tensor mask) {
  if (random->Uniform() < variation.drop_key) {
    mask.zero_();
  } else if (random->Uniform() < variation.partial_key) {
    const double keep = random->Uniform(0.3, 1.0);
    for (int64_t j = 0; j < mask.size(0); ++j) {
      if (random->Uniform() >= keep) mask[j] = 0;
    }
  }
}

}  // namespace

MotionBatch MotionBatch::First(int64_t windows) const {
  MotionBatch first = *this;
  const int64_t count = std::max<int64_t>(1, windows);
  TransitionTensors& of = first.transition;
  for (torch::Tensor* tensor :
       {&of.history_position, &of.history_rotation, &of.target_position, &of.target_rotation,
        &of.target_mask, &first.truth.position, &first.truth.rotation, &first.features,
        &first.audio, &first.has_audio})
    *tensor = tensor->narrow(0, 0, count);
  return first;
}

MotionBatch DrawMotion(const std::vector<PreparedClip>& clips, int batch, int history, int frames,
                       const MotionVariation& variation, torch::Device device, Random* random) {
  const Skeleton& skeleton = clips.front().skeleton;
  const int window = history + frames;
  std::vector<int64_t> of_clips;
  for (const PreparedClip& clip : clips) of_clips.push_back(std::ssize(clip.motion.frames));
  const WindowPicker picker(of_clips, window);
  const PoseCodec codec(skeleton);
  const int joints = skeleton.joints(), width = codec.width();
  torch::Tensor position = torch::empty({batch, window, 3});
  torch::Tensor rotation = torch::empty({batch, window, joints, 3});
  torch::Tensor features = torch::empty({batch, window, width});
  torch::Tensor audio = torch::zeros({batch, window, kMfccCount});
  torch::Tensor has_audio = torch::zeros({batch, 1});
  torch::Tensor mask = torch::ones({batch, joints + 1});

  for (int b = 0; b < batch; ++b) {
    const auto [index, start] = picker.Draw(random);
    const PreparedClip& clip = clips[index];
    const DrawnWindow drawn = DrawWindow(start, of_clips[index], window, variation, random);
    std::vector<Pose> poses = PosesOf(clip, drawn, window);
    if (random->Uniform() < variation.hold_history) {
      const int64_t known = random->Integer(1, history);
      std::fill(poses.begin(), poses.begin() + (history - known + 1), poses[history - known + 1]);
    }
    const GroundFrame frame = GroundFrame::Of(poses[history]);
    Pose previous = frame.ToLocal(poses[0]);
    for (int t = 0; t < window; ++t) {
      const Pose pose = frame.ToLocal(poses[t + 1]);
      const Eigen::VectorXf x =
          codec.Encode(pose, previous, ContactsAt(clip, drawn, t + 1), clip.motion.fps);
      std::copy(x.data(), x.data() + width, features[b][t].data_ptr<float>());
      Eigen::Map<Eigen::Vector3f>(position[b][t].data_ptr<float>()) =
          pose.root_position.cast<float>();
      Eigen::Map<Eigen::Matrix3Xf>(rotation[b][t].data_ptr<float>(), 3, joints) =
          pose.rotations.cast<float>();
      previous = pose;
    }
    if (clip.audio.size() > 0 && random->Uniform() >= variation.drop_audio) {
      has_audio[b][0] = 1;
      for (int t = 0; t < window; ++t)
        std::copy_n(clip.audio.col(std::lround(drawn.Source(t + 1))).data(), kMfccCount,
                    audio[b][t].data_ptr<float>());
    }
    VaryKey(variation, random, mask[b]);
  }

  const torch::Tensor matrices = ExpMapBatch(rotation);
  const auto there = [&](const torch::Tensor& tensor) { return tensor.to(device); };
  return {
      .transition = {frames, there(position.narrow(1, 0, history)),
                     there(matrices.narrow(1, 0, history)), there(position.select(1, window - 1)),
                     there(matrices.select(1, window - 1)), there(mask)},
      .truth = {there(position.narrow(1, history, frames)),
                there(matrices.narrow(1, history, frames))},
      .features = there(features),
      .audio = there(audio),
      .has_audio = there(has_audio)};
}

int DrawnLength(const PaperOptions& options, Random* random) {
  const double u = random->Uniform();
  const double place = random->Uniform() < 0.5 ? u * u : u;
  return options.shortest + static_cast<int>(place * (options.longest - options.shortest + 1));
}

MotionVariation VariationOf(const PaperOptions& options, bool keys) {
  return {.mirror = true,
          .drop_key = keys ? 0.1 : 1.0,
          .drop_audio = 0.15,
          .partial_key = keys ? 0.1 : 0.0,
          .tempo = options.tempo,
          .hold_history = 0.05};
}

}  // namespace choreo
