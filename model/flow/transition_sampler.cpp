#include "model/flow/transition_sampler.h"

#include <algorithm>
#include <utility>

#include "model/core/limits.h"
#include "model/motion/canonical.h"

namespace choreo {
namespace {

// The uses of a frame's random numbers after those of its motion, the window's energy and the
// energy's curve.
enum Decision { kFreeTurn, kWayToKey, kDecisions };

// The most standard deviations from the usual height and tilt (UsualPose::Deviation) at which a
// window without a key may end, unless it began farther off. One in 200 of the training clips'
// frames is farther. A dance that goes there knows no way back: it falls or floats.
constexpr double kMaxDeviation = 7;
constexpr int kMaxRetakes = 4;

double NumberFor(Decision decision, const FlowModelParts& model, const FlowNoise& noise) {
  const auto first = static_cast<size_t>(model.prior.dimensions() + 2 * kBodyParts);
  std::vector<float> normal(first + kDecisions);
  noise.Fill(0, normal);
  return normal[first + decision];
}

}  // namespace

TransitionSampler::TransitionSampler(const FlowModelParts& model, const FlowNetwork& network,
                                     WindowRequest request, const FlowNoise& noise)
    : model_(&model),
      network_(&network),
      request_(std::move(request)),
      noise_(noise),
      windows_((request_.frames + model.config.window_frames - 1) / model.config.window_frames),
      emitted_(request_.history) {
  if (request_.turning) return;
  request_.turning = model.turns.Sample(model.skeleton, request_,
                                        NumberFor(kWayToKey, model, noise), noise.temperature);
}

bool TransitionSampler::Continue() {
  if (!window_) BeginWindow();
  if (window_->Continue()) return true;
  EndWindow();
  return sampled_ < windows_;
}

void TransitionSampler::BeginWindow() {
  const int frames = request_.frames * (sampled_ + 1) / windows_ - frames_;
  ground_ = GroundFrame::Of(emitted_.back());
  FlowNoise noise = noise_;
  noise.first_frame += frames_;
  noise.candidate += static_cast<uint32_t>(kMaxCandidates * retakes_);
  if (!noise.like.empty()) noise.like.erase(noise.like.begin(), noise.like.begin() + frames_);
  WindowRequest part =
      request_.Part(frames_, frames, std::span(emitted_).last(request_.history.size()), ground_);
  if (part.key && part.to_key > kSightFrames) {  // training shows none so far away
    part.key.reset();
    part.turning.reset();
  }
  if (part.FrontCounts()) {
    part.turn = FreeTurn(model_->prior, part,
                         std::min(noise.temperature, 1.0) * NumberFor(kFreeTurn, *model_, noise));
  }
  free_ = !(part.key && part.to_key == part.frames);
  window_.emplace(*model_, *network_, std::move(part), noise);
}

bool TransitionSampler::Retakes(const std::vector<Pose>& poses) {
  if (!free_ || noise_.temperature <= 0 || request_.controls[kRootPath].IsRequested(kPathHeight))
    return false;
  const UsualPose& usual = model_->prior.usual();
  const double most = std::max(kMaxDeviation, usual.Deviation(emitted_.back()));
  const double deviation = usual.Deviation(ground_.ToWorld(poses.back()));
  if (retakes_ == 0 || deviation < nearest_deviation_) {
    nearest_ = poses;
    nearest_deviation_ = deviation;
  }
  return deviation > most && retakes_++ < kMaxRetakes;
}

void TransitionSampler::EndWindow() {
  std::vector<Pose> poses = window_->TakePoses();
  window_.reset();
  if (Retakes(poses)) return;
  if (retakes_ > 0) poses = std::move(nearest_);
  retakes_ = 0;
  for (const Pose& pose : poses) {
    emitted_.push_back(ground_.ToWorld(pose));
    MakeContinuous(emitted_.back(), emitted_[emitted_.size() - 2]);
    ++frames_;
  }
  ++sampled_;
}

std::vector<Pose> TransitionSampler::TakePoses() {
  std::vector<Pose> poses = std::exchange(emitted_, {});
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(request_.history.size()));
  return poses;
}

}  // namespace choreo
