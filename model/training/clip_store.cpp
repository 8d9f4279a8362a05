#include "model/training/clip_store.h"

#include <torch/torch.h>

#include <algorithm>

#include "model/flow/torch_kinematics.h"
#include "model/motion/canonical.h"
#include "model/motion/mirror.h"
#include "model/training/window_picker.h"

namespace choreo {

ClipStore::ClipStore(const std::vector<std::filesystem::path>& folders,
                     const std::filesystem::path& splits_file, const std::set<std::string>& groups)
    : clips_(LoadClips(folders, splits_file, groups)), skeleton_(clips_.front().skeleton) {
  for (const PreparedClip& clip : clips_) frames_.push_back(std::ssize(clip.motion.frames));
}

bool ClipStore::HasMusic() const {
  return std::ranges::any_of(clips_,
                             [](const PreparedClip& clip) { return clip.audio.cols() > 0; });
}

MotionBatch ClipStore::Draw(int batch, int history, int frames, const Variation& variation,
                            Random* random) const {
  const int window = history + frames;
  const WindowPicker picker(frames_, window);
  const PoseCodec codec(skeleton_);
  const int joints = skeleton_.joints(), width = codec.width();
  const int audio_width = 40;
  torch::Tensor position = torch::empty({batch, window, 3});
  torch::Tensor rotation = torch::empty({batch, window, joints, 3});
  torch::Tensor features = torch::empty({batch, window, width});
  torch::Tensor audio = torch::zeros({batch, window, audio_width});
  torch::Tensor has_audio = torch::zeros({batch, 1});
  torch::Tensor mask = torch::ones({batch, joints + 1});

  for (int b = 0; b < batch; ++b) {
    const auto [index, start] = picker.Draw(random);
    const PreparedClip& clip = clips_[index];
    const bool mirrored = variation.mirror && random->Uniform() < 0.5;
    const auto first = clip.motion.frames.begin() + (start - 1);
    std::vector<Pose> poses(first, first + window + 1);
    if (mirrored) {
      for (Pose& pose : poses) pose = Mirror(skeleton_, pose);
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
        // Contacts stand left then right; a mirrored dancer swaps them.
        contacts[foot] = clip.contacts(mirrored ? (foot + 2) % 4 : foot, start + t);
      }
      const Eigen::VectorXf x = codec.Encode(pose, previous, contacts, clip.motion.fps);
      std::copy(x.data(), x.data() + width, features[b][t].data_ptr<float>());
      for (int axis = 0; axis < 3; ++axis)
        position[b][t].data_ptr<float>()[axis] = static_cast<float>(pose.root_position[axis]);
      float* out = rotation[b][t].data_ptr<float>();
      for (Eigen::Index i = 0; i < pose.rotations.size(); ++i)
        out[i] = static_cast<float>(pose.rotations.data()[i]);
      previous = pose;
    }
    if (clip.audio.size() > 0 && random->Uniform() >= variation.drop_audio) {
      has_audio[b][0] = 1;
      std::copy(clip.audio.col(start).data(),
                clip.audio.col(start).data() + int64_t{window} * audio_width,
                audio[b].data_ptr<float>());
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
  MotionBatch result;
  result.transition = {frames,
                       position.narrow(1, 0, history),
                       matrices.narrow(1, 0, history),
                       position.select(1, window - 1),
                       matrices.select(1, window - 1),
                       mask};
  result.truth = {position.narrow(1, history, frames), matrices.narrow(1, history, frames)};
  result.features = features;
  result.audio = audio;
  result.has_audio = has_audio;
  return result;
}

MotionBatch MotionBatch::To(torch::Device device) const {
  MotionBatch batch = *this;
  for (torch::Tensor* tensor :
       {&batch.transition.history_position, &batch.transition.history_rotation,
        &batch.transition.target_position, &batch.transition.target_rotation,
        &batch.transition.target_mask, &batch.truth.position, &batch.truth.rotation,
        &batch.features, &batch.audio, &batch.has_audio}) {
    if (tensor->defined()) *tensor = tensor->to(device);
  }
  return batch;
}

}  // namespace choreo
