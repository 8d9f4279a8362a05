#include "model/dance/transition.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/dance/timeline.h"
#include "model/dance/validation.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// On the shortest vectors for the last pose, continuous backwards from there: what motion of the
// training data looks like, however many turns a dance has made by then.
std::vector<Pose> CanonicalHistory(const GroundFrame& ground, const std::vector<Pose>& world) {
  std::vector<Pose> local(world.size());
  Pose near{{}, Eigen::Matrix3Xd::Zero(3, world.back().rotations.cols())};
  for (size_t i = world.size(); i-- > 0; near = local[i]) {
    local[i] = ground.ToLocal(world[i]);
    MakeContinuous(local[i], near);
  }
  return local;
}

// Where a key leaves its place open, a path says where it is.
std::optional<Target> Placed(std::optional<Target> target, const Controls& controls) {
  const Eigen::Matrix3Xd& path = controls.root_path;
  if (target && !target->mask.root_position && path.cols() > 0) {
    target->pose.root_position = path.col(path.cols() - 1);
    target->mask.root_position = true;
  }
  return target;
}

constexpr int kFootworkFrames = 300;  // put on their feet at once

// GCC 12's SLP vectoriser folds double -> float -> double of neighbours into nothing (as in Eigen's
// cast<float>().cast<double>() of a Vector3d at -O3); it can't see through a volatile.
double ToFloat(double value) {
  volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace

Pose RoundToFloat(const Pose& pose) {
  return {pose.root_position.unaryExpr(&ToFloat), pose.rotations.unaryExpr(&ToFloat)};
}

std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses) {
  const size_t tau = static_cast<size_t>(model.history_frames);
  const Pose earliest = RoundToFloat(poses.empty() ? RestPose(model.skeleton) : poses.front());
  std::vector<Pose> history(tau, earliest);
  const std::span<const Pose> newest = poses.last(std::min(tau, poses.size()));
  std::ranges::transform(newest, history.end() - std::ssize(newest), &RoundToFloat);
  return history;
}

void MoveOn(const Pose& newest, std::vector<Pose>* history) {
  std::rotate(history->begin(), history->begin() + 1, history->end());
  history->back() = newest;
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

TransitionRun::TransitionRun(const ModelInfo& model, const TransitionRequest& request)
    : model_(&model), spec_(request), world_target_(Placed(request.target, request.controls)) {
  CheckedIn(request.frames, 1, std::min(model.max_transition_frames, kMaxTransitionFrames),
            "frames");
  for (size_t i = 0; i < request.history.size(); ++i) {
    CheckJoints(model.skeleton, request.history[i], "history[" + std::to_string(i) + "]");
  }
  if (request.target) CheckJoints(model.skeleton, request.target->pose, "target");
  if (request.after) {
    CheckJoints(model.skeleton, *request.after, "after");
    if (!request.target) throw InvalidArgument("after", "needs a target");
  }

  const std::vector<Pose> history = FillHistory(model, request.history);
  world_ = history.back();
  ground_ = GroundFrame::Of(world_);
  spec_.history = CanonicalHistory(ground_, history);
  stage_ = request.stage.value_or(world_.root_position);
  spec_.stage = ground_.ToLocal(stage_);
  if (world_target_) {
    Target& target = spec_.target.emplace(*world_target_);
    target.pose = ground_.ToLocal(target.pose);
    MakeContinuous(target.pose, spec_.history.back());
    target.height = target.mask.root_position
                        ? std::nullopt
                        : StandingHeight(model.skeleton, world_target_->pose, target.mask);
  }
  for (auto place : spec_.controls.root_path.colwise())
    place = ground_.ToLocal(Eigen::Vector3d(place)).unaryExpr(&ToFloat);
  footwork_ = request.footwork;
  if (footwork_ && FootLock::Fits(model.skeleton, model.fps, request.frames)) {
    foot_lock_.emplace(model.skeleton, model.fps, request.frames, spec_.history, spec_.target);
  }
  if (!request.target || request.arrival_frames <= 0) return;
  std::optional<Pose> after;
  if (request.after) after = ground_.ToLocal(*request.after);
  arrival_.emplace(request.arrival_frames, request.frames, *spec_.target, spec_.history, after);
}

void TransitionRun::CheckFinite(const Pose& pose, std::span<const float> contacts,
                                const std::string& whose) const {
  bool finite = pose.root_position.allFinite() && pose.rotations.allFinite();
  for (float contact : contacts) finite = finite && std::isfinite(contact);
  if (finite && pose.rotations.cols() == model_->skeleton.joints()) return;
  throw Error(ErrorCode::kInternal, "",
              "frame " + std::to_string(spec_.first_frame + done_) + ", " + whose +
                  ", is not a finite pose");
}

// Of a plan the frames that come next. A long one is put on its feet piece by piece, so that nobody
// waits for all of it.
void TransitionRun::PutOnFeet() {
  const auto from = plan_.begin() + done_;
  const bool ends = std::distance(from, plan_.end()) <= kFootworkFrames;
  const auto to = ends ? plan_.end() : from + kFootworkFrames;
  std::vector<Pose> history = spec_.history;
  history.insert(history.end(), plan_.begin(), from);
  const FootworkContext context{.skeleton = model_->skeleton,
                                .history = std::span(history).last(spec_.history.size()),
                                .keyed = ends && arrival_,
                                .has_path = spec_.controls.root_path.cols() > 0,
                                .offset_before = standing_.offset,
                                .fps = model_->fps,
                                .options = model_->footwork};
  std::vector<Pose> piece(from, to);
  Footwork footwork = StandOnFeet(context, &piece);
  std::ranges::copy(piece, from);
  standing_.contacts.insert(standing_.contacts.end(), footwork.contacts.begin(),
                            footwork.contacts.end());
  standing_.offset = footwork.offset;
}

DanceFrame TransitionRun::Take(const StepOutput& raw) {
  CheckFinite(raw.pose, raw.contacts, "as the model makes it");
  if (raw.log_likelihood && !std::isfinite(*raw.log_likelihood)) {
    throw Error(
        ErrorCode::kInternal, "",
        "the likelihood of frame " + std::to_string(spec_.first_frame + done_) + " is not finite");
  }
  const PoseMask mask = spec_.target ? spec_.target->mask : PoseMask{};
  if (done_ == 0 && footwork_ && !raw.plan.empty()) {
    // Of a plan all frames are known: arrival steers them ahead of time, as it will one by one.
    plan_.assign(raw.plan.begin(), raw.plan.end());
    if (std::optional<Arrival> arrival = arrival_) {
      for (Pose& pose : plan_) pose = arrival->Apply(pose);
    }
  }
  const auto at = static_cast<size_t>(done_);
  if (at < plan_.size() && at == standing_.contacts.size()) PutOnFeet();
  steered_ = arrival_ ? arrival_->Apply(raw.pose) : raw.pose;
  if (arrival_ && spec_.frames - done_ <= arrival_->window()) {
    correction_m_ = std::max(correction_m_,
                             ComparePoses(model_->skeleton, raw.pose, steered_, mask).position_m);
  }
  Pose emitted = steered_;
  Contacts contacts = raw.contacts;
  if (at < standing_.contacts.size()) {
    emitted = plan_[at];
    contacts = standing_.contacts[at];
  } else if (foot_lock_) {
    emitted = foot_lock_->Apply(steered_);
    contacts = foot_lock_->contacts();
  }
  world_ = RoundToFloat(KeepSigns(ground_.ToWorld(emitted), world_));
  CheckFinite(world_, contacts, "as arrival and footwork leave it");
  ++done_;
  if (done_ == spec_.frames && spec_.target) {
    const PoseError final = ComparePoses(model_->skeleton, world_, world_target_->pose, mask);
    arrival_result_ =
        ArrivalResult{ComparePoses(model_->skeleton, raw.pose, spec_.target->pose, mask).position_m,
                      final.position_m, final.angle_deg, correction_m_};
  }
  if (spec_.controls.root_path.cols() > 0 || (arrival_result_ && mask.root_position))
    stage_ = world_.root_position;
  DanceFrame frame{world_, contacts, raw.log_likelihood};
  const auto& factors = spec_.controls.velocity_factors;
  if (factors.cols() > 0)
    std::ranges::copy(factors.col(done_ - 1), frame.asked_speeds.emplace().begin());
  return frame;
}

std::optional<RequiredSpeed> TransitionRun::required_speed() const {
  if (!spec_.target) return std::nullopt;
  const Pose& from = spec_.history.back();
  const Target& target = *spec_.target;
  const double seconds = spec_.frames / model_->fps;
  RequiredSpeed speed;
  // What a path asks for is told of the path.
  if (target.mask.root_position && spec_.controls.root_path.cols() == 0) {
    speed.root_m_per_s = (target.pose.root_position - from.root_position).norm() / seconds;
  }
  for (int joint = 0; joint < from.rotations.cols(); ++joint) {
    if (!target.mask.Asks(joint)) continue;
    const double angle =
        RotationDifference(from.rotations.col(joint), target.pose.rotations.col(joint)).norm();
    if (angle / seconds > speed.joint_rad_per_s) {
      speed.joint_rad_per_s = angle / seconds;
      speed.joint = joint;
    }
  }
  return speed;
}

}  // namespace choreo
