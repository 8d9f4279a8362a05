#include "model/engine/torch_engine.h"

#include <ATen/Parallel.h>
#include <ATen/Version.h>
#include <torch/cuda.h>
#include <torch/torch.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/core/random.h"
#include "model/core/threads.h"
#include "model/engine/torch_tile.h"
#include "model/flow/checkpoint.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_codec.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

using torch::Tensor;

torch::Device ToTorch(const Device& device) {
  return device.kind == Device::Kind::kCpu
             ? torch::Device(torch::kCPU)
             : torch::Device(torch::kCUDA, static_cast<torch::DeviceIndex>(device.index));
}

// What LibTorch's own kernels were chosen for, as in "AVX512"; empty if it doesn't tell.
std::string CpuCapability() {
  const std::string config = at::show_config();
  const std::string key = "CPU capability usage: ";
  const size_t at = config.find(key);
  if (at == std::string::npos) return "";
  const size_t begin = at + key.size();
  return config.substr(begin, config.find('\n', begin) - begin);
}

// Everything that can change a bit: weights, build, libraries, kernels, threads, tile.
std::string Fingerprint(const Checkpoint& checkpoint, const torch::Device& device, int tile_rows) {
  std::string kernels = "torch " TORCH_VERSION ", ";
  if (device.is_cuda()) {
    kernels += "cuda";
  } else {
    kernels += DetectBlas().name + ", " + CpuCapability() + ", " +
               std::to_string(at::get_num_threads()) + " threads";
  }
  return checkpoint.model->config().preset + "/" + checkpoint.hash + "/choreo " CHOREO_VERSION "/" +
         kernels + ", tile " + std::to_string(tile_rows);
}

std::string LicenceOf(const std::string& card) {
  const auto json = nlohmann::json::parse(card, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json.value("licence", "") : "";
}

Tensor Positions(std::span<const Pose> poses) {
  Tensor positions = torch::empty({static_cast<int64_t>(poses.size()), 3});
  float* out = positions.data_ptr<float>();
  for (const Pose& pose : poses) {
    Eigen::Map<Eigen::Vector3f>(std::exchange(out, out + 3)) = pose.root_position.cast<float>();
  }
  return positions;
}

Tensor Rotations(std::span<const Pose> poses) {
  const int64_t joints = poses[0].rotations.cols();
  Tensor matrices = torch::empty({static_cast<int64_t>(poses.size()), joints, 3, 3});
  float* out = matrices.data_ptr<float>();
  for (const Pose& pose : poses) {
    for (int64_t joint = 0; joint < joints; ++joint, out += 9) {
      Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{out} =
          ExpMap(pose.rotations.col(joint)).cast<float>();
    }
  }
  return matrices;
}

// One transition in progress. What the tile reads stands in the engine's tensors, at the slot's
// row.
struct Slot {
  bool taken = false;
  int frames = 0;  ///< N
  int frame = 0;   ///< next to be stepped
  uint64_t seed = 0;
  uint32_t candidate = 0;
  int64_t first_frame = 0;
  float temperature = 0;
  bool has_audio = false;
  std::vector<Pose> plan;   ///< [N] reference poses; empty where features are absolute
  Tensor static_condition;  ///< [N, static_width], on the CPU
  Pose last;                ///< emitted before `frame`
  JointPlacement last_placement;
  std::optional<ContactDetector> contacts;
};

class TorchEngine : public StepEngine {
 public:
  TorchEngine(std::shared_ptr<TorchWeights> weights, ModelInfo info, std::string device, int slots,
              int tile_rows)
      : weights_(std::move(weights)),
        info_(std::move(info)),
        device_(std::move(device)),
        codec_(info_.skeleton),
        tau_(info_.history_frames),
        slots_(static_cast<size_t>(slots)),
        tile_(weights_, tile_rows) {
    past_ = torch::zeros({slots, tau_, codec_.width()});
    audio_ = torch::zeros({slots, tau_ + 1, info_.audio_features});
    states_ = torch::zeros({slots, weights_->model->StateWidth()}, weights_->device);
    for (Slot& slot : slots_) slot.contacts.emplace(info_.skeleton);
  }

  const ModelInfo& model() const override { return info_; }
  std::string device() const override { return device_; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override {
    return static_cast<int>(std::ranges::count(slots_, false, &Slot::taken));
  }
  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].taken = false; }

  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  void CheckSpec(const TransitionSpec& spec) const;
  void CheckPose(const Pose& pose, const std::string& field) const;
  void Begin(const TransitionSpec& spec, Slot* slot) const;
  void FillHistory(const TransitionSpec& spec, int index);
  void CheckInput(const StepInput& input) const;
  void Advance(const StepInput& input);
  void StepTile(std::span<const StepInput> in, std::span<StepOutput> out);
  Eigen::Map<Eigen::VectorXf> PastRow(int slot, int64_t row) {
    return {past_[slot][row].data_ptr<float>(), codec_.width()};
  }

  std::shared_ptr<TorchWeights> weights_;
  ModelInfo info_;
  std::string device_;
  PoseCodec codec_;
  int tau_;
  std::vector<Slot> slots_;
  TorchTile tile_;
  Tensor past_;                 ///< [slots, tau, width] features of the frames before, oldest first
  Tensor audio_;                ///< [slots, tau + 1, audio_features] rows t-tau..t
  Tensor states_;               ///< [slots, StateWidth()], on the device
  PoseCodec::Decoded decoded_;  ///< kept for their memory
  JointPlacement placement_;
};

void TorchEngine::CheckPose(const Pose& pose, const std::string& field) const {
  if (pose.rotations.cols() != info_.skeleton.joints()) {
    throw InvalidArgument(field, std::to_string(pose.rotations.cols()) + " joints, must be " +
                                     std::to_string(info_.skeleton.joints()));
  }
}

void TorchEngine::CheckSpec(const TransitionSpec& spec) const {
  if (spec.frames < 1 || spec.frames > info_.max_transition_frames) {
    throw InvalidArgument("frames", std::to_string(spec.frames) + " is not in [1, " +
                                        std::to_string(info_.max_transition_frames) + "]");
  }
  if (static_cast<int>(spec.history.size()) != tau_) {
    throw InvalidArgument(
        "history", std::to_string(spec.history.size()) + " poses, must be " + std::to_string(tau_));
  }
  for (size_t i = 0; i < spec.history.size(); ++i) {
    CheckPose(spec.history[i], "history[" + std::to_string(i) + "]");
  }
  if (spec.target) {
    CheckPose(spec.target->pose, "target");
    const size_t masked = spec.target->mask.joints.size();
    if (masked != 0 && static_cast<int>(masked) != info_.skeleton.joints()) {
      throw InvalidArgument("target.mask", std::to_string(masked) + " joints, must be 0 or " +
                                               std::to_string(info_.skeleton.joints()));
    }
  }
  if (spec.has_audio &&
      (spec.audio_history.rows() != info_.audio_features || spec.audio_history.cols() != tau_)) {
    throw InvalidArgument("audio_history", std::to_string(spec.audio_history.rows()) + " x " +
                                               std::to_string(spec.audio_history.cols()) +
                                               ", must be " + std::to_string(info_.audio_features) +
                                               " x " + std::to_string(tau_));
  }
}

int TorchEngine::Admit(const TransitionSpec& spec) {
  CheckSpec(spec);
  const auto free = std::ranges::find(slots_, false, &Slot::taken);
  if (free == slots_.end()) {
    throw Error(ErrorCode::kResourceExhausted, "",
                "all " + std::to_string(slots_.size()) + " slots are taken");
  }
  const c10::InferenceMode inference;
  const int index = static_cast<int>(free - slots_.begin());
  free->frames = spec.frames;
  free->frame = 0;
  free->seed = spec.seed;
  free->candidate = spec.candidate;
  free->first_frame = spec.first_frame;
  free->temperature = spec.temperature;
  free->has_audio = spec.has_audio;
  Begin(spec, &*free);
  FillHistory(spec, index);
  states_[index].zero_();
  free->taken = true;
  return index;
}

// Plans the transition and hoists its static condition.
void TorchEngine::Begin(const TransitionSpec& spec, Slot* slot) const {
  const int joints = info_.skeleton.joints();
  // Where no key is asked for, the last pose stands in: the mask hides it.
  const Pose& goal = spec.target ? spec.target->pose : spec.history.back();
  Tensor mask = torch::zeros({1, joints + 1});
  if (spec.target) {
    const PoseMask& asked = spec.target->mask;
    float* out = mask.data_ptr<float>();
    for (int joint = 0; joint < joints; ++joint) {
      out[joint] = asked.joints.empty() || asked.joints[static_cast<size_t>(joint)] ? 1.0F : 0.0F;
    }
    out[joints] = asked.root_position ? 1.0F : 0.0F;
  }
  const auto batched = [&](const Tensor& one) { return one.unsqueeze(0).to(weights_->device); };
  FlowModel model = weights_->model;
  const TransitionContext context =
      model->Begin({.frames = spec.frames,
                    .history_position = batched(Positions(spec.history)),
                    .history_rotation = batched(Rotations(spec.history)),
                    .target_position = Positions({&goal, 1}).to(weights_->device),
                    .target_rotation = Rotations({&goal, 1}).to(weights_->device),
                    .target_mask = mask.to(weights_->device)});
  slot->static_condition = context.static_condition[0].cpu().contiguous();
  slot->plan.clear();
  if (!context.reference.position.defined()) return;

  const Tensor position = context.reference.position[0].cpu().contiguous();
  const Tensor rotation = context.reference.rotation[0].cpu().contiguous();
  const Pose* before = &spec.history.back();
  slot->plan.resize(static_cast<size_t>(spec.frames));
  for (int t = 0; t < spec.frames; ++t) {
    Pose& pose = slot->plan[static_cast<size_t>(t)];
    pose.root_position =
        Eigen::Map<const Eigen::Vector3f>(position[t].data_ptr<float>()).cast<double>();
    pose.rotations.resize(3, joints);
    const float* matrices = rotation[t].data_ptr<float>();
    for (int joint = 0; joint < joints; ++joint, matrices += 9) {
      const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> matrix(matrices);
      pose.rotations.col(joint) =
          NearestBranch(LogMap(matrix.cast<double>()), before->rotations.col(joint));
    }
    before = &pose;
  }
}

// The window in front of frame 0. With a plan, history stands on itself, as in training.
void TorchEngine::FillHistory(const TransitionSpec& spec, int index) {
  Slot& slot = slots_[static_cast<size_t>(index)];
  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history) {
    placements.push_back(ForwardKinematics(info_.skeleton, pose));
  }
  slot.contacts->Reset();
  for (int t = 0; t < tau_; ++t) {
    // The first frame takes its speed from the step that follows it.
    const auto before = static_cast<size_t>(std::max(0, t - 1));
    const auto now = static_cast<size_t>(t == 0 ? std::min(1, tau_ - 1) : t);
    slot.contacts->Next(placements[before].positions, placements[now].positions, info_.fps);
    const Pose& pose = spec.history[static_cast<size_t>(t)];
    codec_.Encode(pose, spec.history[before], slot.plan.empty() ? nullptr : &pose,
                  slot.contacts->contacts(), info_.fps, PastRow(index, t));
  }
  if (tau_ > 1) {
    PastRow(index, 0).segment<3>(codec_.velocity_at()) =
        PastRow(index, 1).segment<3>(codec_.velocity_at());
  }
  slot.last_placement = std::move(placements.back());
  slot.last = spec.history.back();

  audio_[index].zero_();
  if (spec.has_audio) {
    Eigen::Map<Eigen::MatrixXf>(audio_[index].data_ptr<float>(), info_.audio_features, tau_) =
        spec.audio_history;
  }
}

void TorchEngine::CheckInput(const StepInput& input) const {
  if (input.slot < 0 || input.slot >= slots() || !slots_[static_cast<size_t>(input.slot)].taken) {
    throw InvalidArgument("slot", std::to_string(input.slot) + " holds no transition");
  }
  const Slot& slot = slots_[static_cast<size_t>(input.slot)];
  if (slot.frame >= slot.frames) {
    throw InvalidArgument("slot", std::to_string(input.slot) + " has made its " +
                                      std::to_string(slot.frames) + " frames already");
  }
  if ((slot.frame > 0) != (input.previous != nullptr)) {
    throw InvalidArgument("previous", slot.frame > 0 ? "is missing after the first frame"
                                                     : "is given before the first frame");
  }
  if (input.previous != nullptr) CheckPose(*input.previous, "previous");
  if (slot.has_audio && static_cast<int>(input.audio_row.size()) != info_.audio_features) {
    throw InvalidArgument("audio_row", std::to_string(input.audio_row.size()) +
                                           " values, must be " +
                                           std::to_string(info_.audio_features));
  }
}

// Moves a slot's windows on by what was emitted and what is heard.
void TorchEngine::Advance(const StepInput& input) {
  Slot& slot = slots_[static_cast<size_t>(input.slot)];
  if (input.previous != nullptr) {
    const int64_t width = codec_.width();
    float* past = past_[input.slot].data_ptr<float>();
    std::copy(past + width, past + tau_ * width, past);
    ForwardKinematics(info_.skeleton, *input.previous, placement_);
    slot.contacts->Next(slot.last_placement.positions, placement_.positions, info_.fps);
    const Pose* reference =
        slot.plan.empty() ? nullptr : &slot.plan[static_cast<size_t>(slot.frame - 1)];
    codec_.Encode(*input.previous, slot.last, reference, slot.contacts->contacts(), info_.fps,
                  PastRow(input.slot, tau_ - 1));
    slot.last = *input.previous;
    std::swap(slot.last_placement, placement_);
  }
  if (slot.has_audio) {
    const int64_t features = info_.audio_features;
    float* rows = audio_[input.slot].data_ptr<float>();
    if (slot.frame > 0) std::copy(rows + features, rows + (tau_ + 1) * features, rows);
    std::ranges::copy(input.audio_row, rows + tau_ * features);
  }
}

void TorchEngine::StepTile(std::span<const StepInput> in, std::span<StepOutput> out) {
  const int count = static_cast<int>(in.size());
  const auto copy_row = [](const Tensor& from, int64_t index, float* to) {
    const float* row = from.data_ptr<float>() + index * from.stride(0);
    std::copy(row, row + from.stride(0), to);
  };
  Tensor indices = torch::zeros({tile_.rows()}, torch::kLong);
  for (int row = 0; row < count; ++row) {
    const int index = in[static_cast<size_t>(row)].slot;
    const Slot& slot = slots_[static_cast<size_t>(index)];
    copy_row(past_, index, tile_.past(row));
    copy_row(audio_, index, tile_.audio(row));
    *tile_.has_audio(row) = slot.has_audio ? 1.0F : 0.0F;
    copy_row(slot.static_condition, slot.frame, tile_.condition(row));
    const std::span<float> noise(tile_.noise(row), static_cast<size_t>(codec_.width()));
    FillNormal(slot.seed, slot.candidate, slot.first_frame + slot.frame, noise);
    for (float& value : noise) value *= slot.temperature;
    indices.data_ptr<int64_t>()[row] = index;
  }
  // Rows beyond `count` are padding: they hold what was there, read slot 0's state, and are
  // dropped.
  indices = indices.to(weights_->device);
  FlowState state = states_.index_select(0, indices);
  tile_.Run(&state);
  if (state.size(1) > 0) {
    states_.index_copy_(0, indices.narrow(0, 0, count), state.narrow(0, 0, count));
  }
  for (int row = 0; row < count; ++row) {
    Slot& slot = slots_[static_cast<size_t>(in[static_cast<size_t>(row)].slot)];
    StepOutput& output = out[static_cast<size_t>(row)];
    const Pose* reference =
        slot.plan.empty() ? nullptr : &slot.plan[static_cast<size_t>(slot.frame)];
    codec_.Decode(Eigen::Map<const Eigen::VectorXf>(tile_.features(row), codec_.width()), reference,
                  decoded_);
    output.pose = decoded_.pose;
    for (size_t foot = 0; foot < 4; ++foot) {
      output.contacts[foot] = std::clamp(decoded_.contacts[foot], 0.0F, 1.0F);
    }
    output.log_likelihood = tile_.log_likelihood(row);
    ++slot.frame;
  }
}

void TorchEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  if (in.size() != out.size()) {
    throw InvalidArgument("out", std::to_string(out.size()) + " outputs for " +
                                     std::to_string(in.size()) + " inputs");
  }
  for (const StepInput& input : in) CheckInput(input);  // all of them, before anything moves
  const c10::InferenceMode inference;
  for (const StepInput& input : in) Advance(input);
  const auto rows = static_cast<size_t>(tile_.rows());
  for (size_t first = 0; first < in.size(); first += rows) {
    const size_t count = std::min(rows, in.size() - first);
    StepTile(in.subspan(first, count), out.subspan(first, count));
  }
}

}  // namespace

AvailableDevices TorchDevices() {
  return {.cuda_build = at::hasCUDA(),
          .cuda_devices = static_cast<int>(torch::cuda::device_count())};
}

void SetTorchThreads(int threads) {
  SetMathThreads(threads);
  at::set_num_threads(threads);
}

std::vector<std::unique_ptr<StepEngine>> MakeTorchEngines(const std::filesystem::path& path,
                                                          std::span<const Device> devices,
                                                          int slots) {
  if (slots < 1 || slots > 4096) {
    throw InvalidArgument("slots", std::to_string(slots) + " is not in [1, 4096]");
  }
  const c10::InferenceMode inference;
  // Exact float32 everywhere: bits before speed.
  at::globalContext().setAllowTF32CuBLAS(false);
  at::globalContext().setAllowTF32CuDNN(false);
  at::globalContext().setDeterministicCuDNN(true);

  struct Loaded {
    std::shared_ptr<TorchWeights> weights;
    ModelInfo info;
    int tile_rows = 0;
  };
  std::map<Device, Loaded> loaded;
  std::vector<std::unique_ptr<StepEngine>> engines;
  for (const Device& device : devices) {
    Loaded& here = loaded[device];
    if (!here.weights) {
      Checkpoint checkpoint = LoadCheckpoint(path);
      const FlowConfig& config = checkpoint.model->config();
      here.weights = std::make_shared<TorchWeights>();
      here.weights->device = ToTorch(device);
      checkpoint.model->to(here.weights->device);
      here.weights->inverse_weights = checkpoint.model->InverseWeights();
      here.weights->model = checkpoint.model;
      here.tile_rows = TorchTile::VerifiedRows(here.weights);
      if (here.tile_rows == 1) {
        std::clog << "choreo: on " << device.name()
                  << " a row's bits depend on its batch, so rows are stepped one by one (slower)\n";
      }
      here.info = {.name = config.preset,
                   .fingerprint = Fingerprint(checkpoint, here.weights->device, here.tile_rows),
                   .licence = LicenceOf(checkpoint.card),
                   .card = checkpoint.card,
                   .skeleton = checkpoint.model->skeleton(),
                   .fps = 30,
                   .history_frames = config.history_frames,
                   .audio_features = config.audio_features,
                   .max_transition_frames = config.max_transition_frames,
                   .default_temperature = config.temperature};
    }
    engines.push_back(std::make_unique<TorchEngine>(here.weights, here.info, device.name(), slots,
                                                    here.tile_rows));
  }
  return engines;
}

std::unique_ptr<StepEngine> MakeTorchEngine(const std::filesystem::path& checkpoint,
                                            const Device& device, int slots) {
  return std::move(MakeTorchEngines(checkpoint, {&device, 1}, slots).front());
}

}  // namespace choreo
