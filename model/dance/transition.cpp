#include "model/dance/transition.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/body_limits.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_faults.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr uint32_t kMaxTransitionRetakes = 4;
constexpr std::ptrdiff_t kFootworkFrames = 300;  // footwork's largest part in one slice

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

PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs) {
  const auto& [manner, seed, controls, segment, before, after, noise_like, music] = inputs;
  TransitionSpec spec;
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
  spec.after = after;
  if (before.history.empty()) {
    const Pose stance =
        controls.Stance(segment.from, spec.frames == 1 ? spec.target : std::nullopt);
    spec.history = FillHistory(model, {&stance, 1});
  } else {
    spec.history = FillHistory(model, before.history);
  }
  spec.stage = before.stage;
  spec.music = music.rows;
  spec.energy = music.energy;
  spec.beats = BeatsAround(SecondsOf(music.beats), model.fps, segment.from, spec.frames);
  spec.seed = seed ^ music.id;
  spec.noise_like = noise_like;
  spec.variation = manner.Variation();
  spec.style = manner.style;
  spec.temperature = static_cast<float>(manner.temperature.value_or(model.default_temperature));
  std::vector<Warning> warnings;
  controls.FillControls(key_id, &spec, &warnings);
  if (spec.target) WarnOfPose(model.skeleton, spec, key_id, &warnings);
  TransitionRun run(model, spec);
  if (const auto speed = run.required_speed(); speed && speed->TooFast()) {
    warnings.push_back(
        IntervalTooShort(model.skeleton, key_id, spec.first_frame, spec.frames, *speed));
  }
  return {std::move(run), std::move(warnings)};
}

TransitionRun::TransitionRun(const ModelInfo& model, const TransitionSpec& world)
    : model_(&model), spec_(WithHistory(model, world), model) {
  before_ = spec_->history;
  world_ = before_.back();
  world_target_ = Placed(spec_->target, spec_->controls, world_);
  ground_ = GroundFrame::Of(world_);
  stage_ = spec_->stage.value_or(GroundFrame{world_.root_position, ToFloat(ground_.heading)});
  held_ = spec_->arrival_frames > 0 && IsHold(*spec_, model.fps);
  spec_ = {InCanonicalFrame(*spec_), model};
  arrival_ = ArrivalOf(*spec_, held_ ? Arrival::Lead::kAlone : Arrival::Lead::kWithModel);
}

TransitionSpec TransitionRun::InCanonicalFrame(TransitionSpec spec) const {
  spec.history = CanonicalHistory(ground_, before_);
  spec.stage = ground_.ToLocal(stage_);
  const auto to_local = [&](Target& target) {
    target.height = target.mask.root_position
                        ? std::nullopt
                        : StandingHeight(model_->skeleton, target.pose, target.mask);
    target.pose = ground_.ToLocal(target.pose);
    MakeContinuous(target.pose, spec.history.back());
  };
  if (world_target_) to_local(spec.target.emplace(*world_target_));
  if (spec.later) to_local(spec.later->target);
  spec.controls.ToLocal(ground_);
  for (size_t i = 0; i < spec.controls.rows().size(); ++i)
    spec.controls[i].values = spec.controls[i].values.unaryExpr(&ToFloat);
  if (spec.after)
    spec.after = ground_.ToLocal(*spec.after);
  else if (spec.target && (spec.hit || held_))
    spec.after = spec.target->pose;  // at rest
  return spec;
}

// Whether another sample may be slower, because the direct way to the key is slow enough.
bool TransitionRun::MayBeRetaken() const {
  if (held_ || !spec_->footwork || model_->deterministic || spec_->temperature == 0) return false;
  if (!spec_->target) return true;
  const auto& [pose, mask, height] = *spec_->target;
  const Pose key = Masked(pose, mask, spec_->history.back());
  return SpeedExcess(model_->skeleton, spec_->history.back(), {&key, 1},
                     model_->fps / spec_->frames) <= 1;
}

// The largest ratio of a joint's speed to its limit. Above 1 the motion is faster than human
// bodies.
double TransitionRun::Strain() const {
  return SpeedExcess(model_->skeleton, spec_->history.back(), plan_, model_->fps);
}

Slices<> TransitionRun::Dance(Sampler& sampler) {
  const TransitionRun fresh = *this;
  co_await DanceOnce(sampler);
  if (!MayBeRetaken()) co_return;
  for (uint32_t take = 1; take <= kMaxTransitionRetakes && Strain() > 1; ++take) {
    TransitionRun other = fresh;
    // Distant from the numbers of other candidates and of a sampler's own retries.
    other.set_candidate(fresh.spec().candidate + (take << 16));
    co_await other.DanceOnce(sampler);
    other.set_candidate(fresh.spec().candidate);
    if (other.Strain() < Strain()) *this = std::move(other);
  }
}

Slices<> TransitionRun::DanceOnce(Sampler& sampler) {
  if (held_)
    Hold();
  else
    drawn_ = co_await sampler.Begin(spec_);
  Steer();
  while (frames_.size() < plan_.size()) {
    co_await Pause();
    PutOnFeet();
  }
  MeasureArrival();
}

// Does not use the model, because a new sample in each of these short transitions would look like
// trembling.
void TransitionRun::Hold() {
  Motion motion{.fps = model_->fps,
                .frames = std::vector(static_cast<size_t>(spec_->frames), spec_->target->pose)};
  drawn_.contacts = DetectContacts(model_->skeleton, motion);
  drawn_.poses = std::move(motion.frames);
}

void TransitionRun::Steer() {
  CheckLength();
  const ControlCurve& path = spec_->controls[kRootPath];
  if (spec_->hit && arrival_) {
    HitKey({.skeleton = model_->skeleton,
            .history = spec_->history,
            .has_path = path.IsGiven(),
            .has_heights = path.IsRequested(kPathHeight),
            .fps = model_->fps},
           *spec_->hit, &drawn_.poses);
  }
  plan_.reserve(drawn_.poses.size());
  frames_.reserve(drawn_.poses.size());
  std::optional<Arrival> arrival = arrival_;
  for (size_t at = 0; at < drawn_.poses.size(); ++at) {
    const Pose& drawn = drawn_.poses[at];
    CheckFinite(at, drawn, drawn_.contacts[at], "as the model makes it");
    if (!drawn_.log_likelihoods.empty() && !std::isfinite(drawn_.log_likelihoods[at])) {
      throw Error(ErrorCode::kInternal, "",
                  "the likelihood of frame " +
                      std::to_string(spec_->first_frame + static_cast<int64_t>(at)) +
                      " is not finite");
    }
    plan_.push_back(arrival ? arrival->Apply(drawn) : drawn);
    if (arrival && drawn_.poses.size() - at <= static_cast<size_t>(arrival->window())) {
      correction_m_ = std::max(
          correction_m_,
          ComparePoses(model_->skeleton, drawn, plan_.back(), spec_->target->mask).position_m);
    }
  }
}

void TransitionRun::CheckLength() const {
  const auto frames = static_cast<size_t>(spec_->frames);
  const size_t likelihoods = drawn_.log_likelihoods.size();
  if (drawn_.poses.size() == frames && drawn_.contacts.size() == frames &&
      (likelihoods == 0 || likelihoods == frames))
    return;
  throw Error(ErrorCode::kInternal, "",
              "the model's plan of " + std::to_string(frames) + " frames has " +
                  std::to_string(drawn_.poses.size()) + " poses, " +
                  std::to_string(drawn_.contacts.size()) + " contacts and " +
                  std::to_string(likelihoods) + " likelihoods");
}

void TransitionRun::CheckFinite(size_t frame, const Pose& pose, std::span<const float> contacts,
                                const std::string& whose) const {
  bool finite = pose.root_position.allFinite() && pose.rotations.allFinite();
  for (float contact : contacts) finite = finite && std::isfinite(contact);
  if (finite && pose.rotations.cols() == model_->skeleton.joints()) return;
  throw Error(ErrorCode::kInternal, "",
              "frame " + std::to_string(spec_->first_frame + static_cast<int64_t>(frame)) + ", " +
                  whose + ", is not a finite pose");
}

// Processes only a part of the frames, so that other dances need not wait for a long plan's
// footwork. Parts are about equally long, because in a short last part the pelvis would have to
// move too fast to the key.
void TransitionRun::PutOnFeet() {
  const auto from = plan_.begin() + std::ssize(frames_);
  const std::ptrdiff_t left = plan_.end() - from;
  const std::ptrdiff_t parts = (left + kFootworkFrames - 1) / kFootworkFrames;
  const auto to = from + (left + parts - 1) / parts;
  std::vector<Contacts> contacts;
  if (spec_->footwork) {
    const std::vector<Pose> history =
        LastPoses(spec_->history.size(), spec_->history, std::span(plan_.begin(), from),
                  [](const Pose& pose) -> const Pose& { return pose; });
    const FootworkContext context{
        .skeleton = model_->skeleton,
        .history = history,
        .keyed = to == plan_.end() && arrival_,
        .held = held_,
        .has_path = spec_->controls[kRootPath].IsGiven(),
        .has_heights = spec_->controls[kRootPath].IsRequested(kPathHeight),
        .offset_before = offset_,
        .fps = model_->fps,
        .options = model_->footwork};
    std::vector<Pose> piece(from, to);
    Footwork footwork = StandOnFeet(context, &piece);
    std::ranges::copy(piece, from);
    contacts = std::move(footwork.contacts);
    offset_ = footwork.offset;
  }
  const auto first = frames_.size();
  const auto last = static_cast<size_t>(to - plan_.begin());
  if (!contacts.empty())
    std::ranges::copy(contacts, drawn_.contacts.begin() + static_cast<std::ptrdiff_t>(first));
  for (size_t at = first; at < last; ++at) frames_.push_back(Finish(at));
}

DanceFrame TransitionRun::Finish(size_t at) {
  const Contacts& contacts = drawn_.contacts[at];
  world_ = RoundToFloat(KeepSigns(ground_.ToWorld(plan_[at]), world_));
  CheckFinite(at, world_, contacts, "as arrival and footwork leave it");
  DanceFrame frame{world_, contacts};
  if (!drawn_.log_likelihoods.empty()) frame.log_likelihood = drawn_.log_likelihoods[at];
  if (const ControlCurve& factors = spec_->controls[kVelocityFactors]; factors.IsGiven()) {
    std::ranges::copy(factors.values.col(static_cast<Eigen::Index>(at)).cast<float>(),
                      frame.asked_speeds.emplace().begin());
  }
  return frame;
}

void TransitionRun::MeasureArrival() {
  if (!spec_->target) return;
  const PoseMask& mask = spec_->target->mask;
  const PoseError raw =
      ComparePoses(model_->skeleton, drawn_.poses.back(), spec_->target->pose, mask);
  const PoseError final = ComparePoses(model_->skeleton, world_, world_target_->pose, mask);
  arrival_result_ = KeyReached{.frame = spec_->first_frame + spec_->frames - 1,
                               .raw_error_m = raw.position_m,
                               .final_error_m = final.position_m,
                               .final_error_deg = final.angle_deg,
                               .correction_m = correction_m_};
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
