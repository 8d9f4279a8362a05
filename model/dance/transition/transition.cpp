#include "model/dance/transition/transition.h"

#include <algorithm>
#include <utility>

#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/body_limits.h"
#include "model/motion/pose/pose_faults.h"
#include "model/plan/takes.h"

namespace choreo {
namespace {

constexpr int kSlowArrival = 3;  // times as long, to slow down for the floor

// The last `count` poses of `before` followed by the frames' poses.
template <typename Frames, typename PoseOf>
std::vector<Pose> LastPoses(size_t count, const std::vector<Pose>& before, const Frames& frames,
                            PoseOf pose_of) {
  std::vector<Pose> last;
  const size_t all = before.size() + frames.size();
  for (size_t at = all - std::min(count, all); at < all; ++at)
    last.push_back(at < before.size() ? before[at] : pose_of(frames[at - before.size()]));
  return last;
}

// The spec of a transition with exactly tau poses before it.
TransitionSpec WithHistory(const ModelInfo& model, TransitionSpec spec) {
  spec.history = FillHistory(model, spec.history);
  return spec;
}

// Warns about the key's faults, except those that the preceding pose already has, as when a pose is
// held.
void WarnOfPose(const Skeleton& skeleton, const TransitionSpec& spec, const std::string& key_id,
                std::vector<Warning>* warnings) {
  const PoseMask& mask = spec.target->mask;
  const std::vector<std::string> before = PoseFaults(skeleton, spec.history.back(), mask);
  for (const std::string& fault : PoseFaults(skeleton, spec.target->pose, mask)) {
    if (std::ranges::find(before, fault) == before.end())
      warnings->push_back(KeyImpossible(key_id, spec.first_frame + spec.frames - 1, fault));
  }
}

}  // namespace

TransitionSpec SpecOf(const ModelInfo& model, const DanceManner& manner, uint64_t seed,
                      DancedState before) {
  TransitionSpec spec;
  spec.history = std::move(before.history);
  spec.stage = before.stage;
  spec.seed = seed;
  spec.variation = manner.Variation();
  spec.style = manner.style;
  spec.temperature = static_cast<float>(manner.temperature.value_or(model.default_temperature));
  return spec;
}

PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs) {
  const Segment& segment = inputs.segment;
  TransitionMusic music = inputs.music.Hear();
  TransitionSpec spec = inputs.spec;
  spec.frames = static_cast<int>(segment.to - segment.from);
  spec.first_frame = segment.from;
  const std::string key_id = segment.key ? segment.key->id : "";
  if (segment.key) {
    spec.target = Target{segment.key->pose, segment.key->mask};
    spec.hit = segment.key->hit;
  } else if (segment.later) {
    const Key& key = *segment.later;
    spec.later = {{key.pose, key.mask}, static_cast<int>(key.frame + 1 - segment.to)};
  }
  if (spec.history.empty()) {
    spec.history = {
        inputs.controls.Stance(segment.from, spec.frames == 1 ? spec.target : std::nullopt)};
  }
  spec.history = FillHistory(model, spec.history);
  spec.music = std::move(music.rows);
  spec.energy_shift = music.energy;
  spec.beats = BeatsAround(SecondsOf(music.beats), model.fps, segment.from, spec.frames);
  spec.seed ^= music.id;
  std::vector<Warning> warnings;
  inputs.controls.FillControls(key_id, &spec, &warnings);
  if (spec.target) WarnOfPose(model.skeleton, spec, key_id, &warnings);
  TransitionRun run(model, spec);
  if (const auto speed = run.required_speed(); speed && speed->TooFast()) {
    warnings.push_back(
        IntervalTooShort(model.skeleton, key_id, spec.first_frame, spec.frames, *speed));
  }
  return {std::move(run), std::move(music.beats), std::move(warnings)};
}

TransitionRun::TransitionRun(const ModelInfo& model, const TransitionSpec& world)
    : model_(&model), spec_(WithHistory(model, world), model) {
  before_ = spec_->history;
  const Pose& now = before_.back();
  world_target_ = Placed(spec_->target, spec_->controls, now);
  ground_ = GroundFrame::Of(now);
  stage_ = spec_->stage.value_or(GroundFrame{now.root_position, ToFloat(ground_.heading)});
  held_ = spec_->arrival_frames > 0 && IsHold(*spec_, model.fps);
  spec_.ChangeFrame([this](TransitionSpec* spec) { ToCanonicalFrame(spec); });
}

void TransitionRun::ToCanonicalFrame(TransitionSpec* spec) const {
  spec->history = CanonicalHistory(ground_, before_);
  spec->stage = ground_.ToLocal(stage_);
  const auto to_local = [&](Target& target) {
    target.height = target.mask.root_position
                        ? std::nullopt
                        : StandingHeight(model_->skeleton, target.pose, target.mask);
    target.pose = ground_.ToLocal(target.pose);
    MakeContinuous(target.pose, spec->history.back());
  };
  if (world_target_) to_local(spec->target.emplace(*world_target_));
  if (spec->later) to_local(spec->later->target);
  spec->controls.ToLocal(ground_);
  for (size_t i = 0; i < spec->controls.rows().size(); ++i)
    spec->controls[i].values = spec->controls[i].values.unaryExpr(&ToFloat);
  const bool to_floor = spec->target && EndsOnFloor(*spec);
  if (to_floor) spec->arrival_frames *= kSlowArrival;
  if (spec->after)
    spec->after = ground_.ToLocal(*spec->after);
  else if (spec->target && (spec->hit || held_ || to_floor))
    spec->after = spec->target->pose;  // at rest
}

// Whether the key's pose sits, lies, kneels or leans on its hands. The floor stops a body that goes
// down.
bool TransitionRun::EndsOnFloor(const TransitionSpec& spec) const {
  Pose key = Masked(spec.target->pose, spec.target->mask, spec.history.back());
  if (spec.target->height) key.root_position.y() = *spec.target->height;
  return RestsOnFloor(model_->skeleton, key);
}

// The largest ratio of a joint's speed to the limit of human bodies. 0 if another take would not be
// slower, because the model has no other or the direct way to the key is too fast.
double TransitionRun::ExcessOf(const std::vector<Pose>& poses) const {
  if (held_ || !spec_->footwork || model_->deterministic || spec_->temperature == 0) return 0;
  const Pose& now = spec_->history.back();
  if (spec_->target) {
    const Pose key = Masked(spec_->target->pose, spec_->target->mask, now);
    if (SpeedExcess(model_->skeleton, now, {&key, 1}, model_->fps / spec_->frames) > 1) return 0;
  }
  return SpeedExcess(model_->skeleton, now, poses, model_->fps);
}

Slices<> TransitionRun::Dance(Sampler& sampler) {
  BestTake<ProcessedPlan> best;
  const uint32_t candidate = spec_->candidate;
  SpareFrames spare = SpareFrames::Of(spec_->frames);
  while (best.WantsAnother() && spare.SpendUnlessFirst(best.takes(), spec_->frames)) {
    spec_.SetTake(CandidateOfTake(candidate, kTransitionTake * best.takes()), spare.left());
    ProcessedPlan processed = co_await DanceOnce(sampler);
    spare.Charge(processed.plan.resampled);
    const double excess = ExcessOf(processed.plan.poses);
    best.Add(std::move(processed), excess);
  }
  set_candidate(candidate);
  SetFrames(best.motion());
}

// A hold does not use the model, because a new sample in each of these short transitions would look
// like trembling.
Slices<ProcessedPlan> TransitionRun::DanceOnce(Sampler& sampler) const {
  Plan plan;
  if (held_)
    plan.poses.assign(static_cast<size_t>(spec_->frames), spec_->target->pose);
  else
    plan = co_await sampler.Sample(spec_);
  co_return co_await ProcessPlan(*model_, spec_, held_, std::move(plan));
}

void TransitionRun::SetFrames(const ProcessedPlan& processed) {
  const Plan& plan = processed.plan;
  const ControlCurve& factors = spec_->controls[kVelocityFactors];
  Pose before = before_.back();
  for (size_t at = 0; at < plan.poses.size(); ++at) {
    before = RoundToFloat(KeepSigns(ground_.ToWorld(plan.poses[at]), before));
    DanceFrame& frame = frames_.emplace_back(DanceFrame{before, plan.contacts[at]});
    if (!plan.log_likelihoods.empty()) frame.log_likelihood = plan.log_likelihoods[at];
    if (factors.IsGiven()) {
      std::ranges::copy(factors.values.col(static_cast<Eigen::Index>(at)).cast<float>(),
                        frame.asked_speeds.emplace().begin());
    }
  }
  if (!spec_->target) return;
  const PoseError final =
      ComparePoses(model_->skeleton, frames_.back().pose, world_target_->pose, spec_->target->mask);
  arrival_result_ = KeyReached{.frame = spec_->first_frame + spec_->frames - 1,
                               .raw_error_m = processed.raw_error.position_m,
                               .final_error_m = final.position_m,
                               .final_error_deg = final.angle_deg,
                               .correction_m = processed.correction_m};
}

DancedState TransitionRun::StateAfter(size_t frames) const {
  DancedState state{LastPoses(before_.size(), before_, std::span(frames_).first(frames),
                              [](const DanceFrame& frame) -> const Pose& { return frame.pose; }),
                    stage_};
  const bool is_there =
      frames == frames_.size() && spec_->target && spec_->target->mask.root_position;
  const bool has_path = spec_->controls[kRootPath].IsGiven();
  if (frames > 0 && (is_there || has_path))
    state.stage->origin = state.history.back().root_position;
  return state;
}

TransitionRun DanceTransition(Sampler& sampler, const TransitionSpec& world,
                              const std::function<void(int)>& danced) {
  TransitionRun run(sampler.model(), world);
  run.Dance(sampler).Finish();
  if (danced) danced(world.frames);
  return run;
}

}  // namespace choreo
