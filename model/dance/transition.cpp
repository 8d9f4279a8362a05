#include "model/dance/transition.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/body_limits.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// Rotation vectors grow with each whole turn of a dance. This shortens those of the last pose, and
// keeps the earlier ones continuous with it, as training data are.
std::vector<Pose> CanonicalHistory(const GroundFrame& ground, const std::vector<Pose>& world) {
  std::vector<Pose> local(world.size());
  Pose near{{}, Eigen::Matrix3Xd::Zero(3, world.back().rotations.cols())};
  for (size_t i = world.size(); i-- > 0; near = local[i]) {
    local[i] = ground.ToLocal(world[i]);
    MakeContinuous(local[i], near);
  }
  return local;
}

// Less time than this does not suffice to dance away from a pose and back.
constexpr double kHoldSeconds = 0.4;

// Whether a key is the dancer's present pose.
bool IsHeld(const Target& target, const Pose& now) {
  constexpr double kSame = 1e-3;  // radians
  for (Eigen::Index joint = 0; joint < now.rotations.cols(); ++joint) {
    if (!target.mask.Constrains(joint) ||
        RotationDifference(now.rotations.col(joint), target.pose.rotations.col(joint)).norm() >
            kSame)
      return false;
  }
  return true;
}

// Whether a key's position is the dancer's present one.
bool IsThere(const Target& target, const Pose& now) {
  constexpr double kSamePlace = 0.01;  // metres
  return (target.pose.root_position - now.root_position).norm() < kSamePlace;
}

// A key without a position gets it from the path, if there is one. A dancer who holds a pose stays
// in place.
std::optional<Target> Placed(std::optional<Target> target, const Controls& controls,
                             const Pose& now) {
  if (!target || target->mask.root_position) return target;
  const ControlCurve& path = controls[kRootPath];
  if (path.IsGiven()) {
    target->pose.root_position = path.values.rightCols<1>();
  } else if (IsHeld(*target, now)) {
    target->pose.root_position = now.root_position;
  } else {
    return target;
  }
  target->mask.root_position = true;
  return target;
}

constexpr uint32_t kMaxRetakes = 4;

constexpr std::ptrdiff_t kFootworkFrames = 300;  // that footwork processes in one slice, at most

// The last `count` poses of `before` and then the frames, of which it takes the pose.
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

// The volatile keeps the rounding: GCC 12's SLP vectoriser at -O3 drops double -> float -> double
// of neighbouring numbers, as in Eigen's cast<float>().cast<double>() of a Vector3d.
double ToFloat(double value) {
  volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace

bool IsHold(const TransitionSpec& world, double fps) {
  if (!world.target || world.frames >= kHoldSeconds * fps) return false;
  const Pose& now = world.history.back();
  return IsHeld(*world.target, now) &&
         (!world.target->mask.root_position || IsThere(*world.target, now));
}

Pose RoundToFloat(const Pose& pose) {
  return {pose.root_position.unaryExpr(&ToFloat), pose.rotations.unaryExpr(&ToFloat)};
}

std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses) {
  const size_t tau = static_cast<size_t>(model.history_frames);
  const Pose earliest = RoundToFloat(poses.empty() ? StandingPose(model.skeleton) : poses.front());
  std::vector<Pose> history(tau, earliest);
  const std::span<const Pose> newest = poses.last(std::min(tau, poses.size()));
  std::ranges::transform(newest, history.end() - std::ssize(newest), &RoundToFloat);
  return history;
}

std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames) {
  const auto first = static_cast<double>(first_frame);
  auto from = std::ranges::upper_bound(seconds, (first - 1) / fps);
  auto to = std::ranges::lower_bound(seconds, (first + frames) / fps);
  if (from != seconds.begin()) --from;
  if (to != seconds.end()) ++to;
  std::vector<double> beats(from, to);
  for (double& beat : beats) beat = beat * fps - first;
  return beats;
}

TransitionRun::TransitionRun(const ModelInfo& model, const TransitionSpec& world)
    : model_(&model), spec_(WithHistory(model, world), model) {
  before_ = spec_->history;
  world_ = before_.back();
  world_target_ = Placed(spec_->target, spec_->controls, world_);
  ground_ = GroundFrame::Of(world_);
  stage_ = spec_->stage.value_or(GroundFrame{world_.root_position, ToFloat(ground_.heading)});
  held_ = spec_->arrival_frames > 0 && IsHold(*spec_, model.fps);
  spec_.Change([this](TransitionSpec& spec) { MoveToCanonicalFrame(spec); });
  arrival_ = ArrivalOf(*spec_, held_ ? Arrival::Lead::kAlone : Arrival::Lead::kWithModel);
}

void TransitionRun::MoveToCanonicalFrame(TransitionSpec& spec) {
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
}

// Whether another sample may be slower, as the straight way to the key is slow enough.
bool TransitionRun::MayBeRetaken() const {
  if (held_ || !spec_->footwork || model_->deterministic || spec_->temperature == 0) return false;
  if (!spec_->target) return true;
  const auto& [pose, mask, height] = *spec_->target;
  const Pose key = Masked(pose, mask, spec_->history.back());
  return SpeedExcess(model_->skeleton, spec_->history.back(), {&key, 1},
                     model_->fps / spec_->frames) <= 1;
}

// Above 1 it moves faster than bodies do.
double TransitionRun::Strain() const {
  return SpeedExcess(model_->skeleton, spec_->history.back(), plan_, model_->fps);
}

Slices<> TransitionRun::Dance(Sampler& sampler) {
  const TransitionRun fresh = *this;
  co_await DanceOnce(sampler);
  if (!MayBeRetaken()) co_return;
  for (uint32_t take = 1; take <= kMaxRetakes && Strain() > 1; ++take) {
    TransitionRun other = fresh;
    // Far from the numbers of other candidates and of a sampler's own retakes.
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

// No model is asked: a new sample in each of these short transitions would tremble.
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

// Processes a part of the frames only, so that other dances need not wait for the footwork of a
// long plan. Parts are about equally long: in a short last one the pelvis had to dash to the key.
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

std::optional<RequiredSpeed> TransitionRun::required_speed() const {
  if (!spec_->target) return std::nullopt;
  const Pose& from = spec_->history.back();
  const Target& target = *spec_->target;
  const double seconds = spec_->frames / model_->fps;
  RequiredSpeed speed;
  // The key did not ask for a position that came from the path, so its error does not count here.
  if (target.mask.root_position && !spec_->controls[kRootPath].IsGiven()) {
    speed.root_m_per_s = (target.pose.root_position - from.root_position).norm() / seconds;
  }
  for (int joint = 0; joint < from.rotations.cols(); ++joint) {
    if (!target.mask.Constrains(joint)) continue;
    const double angle =
        RotationDifference(from.rotations.col(joint), target.pose.rotations.col(joint)).norm();
    if (angle / seconds > speed.joint_rad_per_s) {
      speed.joint_rad_per_s = angle / seconds;
      speed.joint = joint;
    }
  }
  return speed;
}

TransitionRun DanceTransition(Sampler& sampler, const TransitionSpec& world,
                              const std::function<void(int)>& danced) {
  TransitionRun run(sampler.model(), world);
  run.Dance(sampler).Finish();
  if (danced) danced(world.frames);
  return run;
}

}  // namespace choreo
