#include "model/papers/training/motion_batch.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>

#include "model/audio/mfcc.h"
#include "model/flow/torch_kinematics.h"
#include "model/motion/canonical.h"
#include "model/motion/mirror.h"
#include "model/motion/pose_codec.h"
#include "model/motion/resample.h"
#include "model/training/window_picker.h"

namespace choreo {
namespace {

const double kMaxTempoChange = std::log(4.0 / 3);  // faster or slower

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
    const auto [index, drawn] = picker.Draw(random);
    const PreparedClip& clip = clips[index];
    const bool mirrored = variation.mirror && random->Uniform() < 0.5;
    int64_t start = drawn;
    double rate = 1;  // frames of the clip per frame
    if (random->Uniform() < variation.tempo) {
      const double other = std::exp(random->Uniform(-kMaxTempoChange, kMaxTempoChange));
      const auto taken = static_cast<int64_t>(std::ceil(window * other)) + 1;
      if (const int64_t spare = of_clips[index] - taken; spare > 0) {
        rate = other;
        start = random->Integer(0, spare) + 1;
      }
    }
    const auto source = [&](int t) { return static_cast<double>(start - 1) + t * rate; };
    std::vector<Pose> poses;
    for (int t = 0; t <= window; ++t) {
      const auto at = static_cast<size_t>(source(t));
      const Pose& pose = clip.motion.frames[at];
      poses.push_back(rate == 1 ? pose
                                : InterpolatePoses(pose, clip.motion.frames[at + 1],
                                                   source(t) - static_cast<double>(at)));
    }
    if (mirrored) {
      for (Pose& pose : poses) pose = Mirror(skeleton, pose);
    }
    if (random->Uniform() < variation.hold_history) {
      const int64_t known = random->Integer(1, history);
      std::fill(poses.begin(), poses.begin() + (history - known + 1), poses[history - known + 1]);
    }
    const GroundFrame frame = GroundFrame::Of(poses[history]);
    Pose previous = frame.ToLocal(poses[0]);
    for (int t = 0; t < window; ++t) {
      const Pose pose = frame.ToLocal(poses[t + 1]);
      Contacts contacts;
      for (int foot = 0; foot < 4; ++foot) {
        // Contacts are left, then right; mirroring swaps them.
        contacts[foot] =
            clip.contacts(mirrored ? (foot + 2) % 4 : foot, std::lround(source(t + 1)));
      }
      const Eigen::VectorXf x = codec.Encode(pose, previous, contacts, clip.motion.fps);
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
        std::copy_n(clip.audio.col(std::lround(source(t + 1))).data(), kMfccCount,
                    audio[b][t].data_ptr<float>());
    }
    if (random->Uniform() < variation.drop_key) {
      mask[b].zero_();
    } else if (random->Uniform() < variation.partial_key) {
      const double keep = random->Uniform(0.3, 1.0);
      for (int j = 0; j <= joints; ++j) {
        if (random->Uniform() >= keep) mask[b][j] = 0;
      }
    }
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
