#include "model/plan/process_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/plan/footwork.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr std::ptrdiff_t kFootworkFrames = 300;  // footwork's largest part in one slice

void CheckLength(const Plan& plan, size_t frames) {
  const auto fits = [frames](const auto& list) { return list.empty() || list.size() == frames; };
  if (plan.poses.size() == frames && fits(plan.contacts) && fits(plan.log_likelihoods)) return;
  throw Error(ErrorCode::kInternal, "",
              "the model's plan of " + std::to_string(frames) + " frames has " +
                  std::to_string(plan.poses.size()) + " poses, " +
                  std::to_string(plan.contacts.size()) + " contacts and " +
                  std::to_string(plan.log_likelihoods.size()) + " likelihoods");
}

void CheckFinite(const Plan& plan, const ModelInfo& model, int64_t first_frame,
                 const std::string& whose) {
  const auto is_finite = [](float value) { return std::isfinite(value); };
  for (size_t at = 0; at < plan.poses.size(); ++at) {
    const Pose& pose = plan.poses[at];
    const bool good =
        // Frames are sent as floats.
        pose.root_position.cast<float>().allFinite() && pose.rotations.cast<float>().allFinite() &&
        pose.rotations.cols() == model.skeleton.joints() &&
        (plan.contacts.empty() || std::ranges::all_of(plan.contacts[at], is_finite)) &&
        (plan.log_likelihoods.empty() || is_finite(plan.log_likelihoods[at]));
    if (good) continue;
    throw Error(ErrorCode::kInternal, "",
                "frame " + std::to_string(first_frame + static_cast<int64_t>(at)) + ", " + whose +
                    ", is not finite");
  }
}

// The contacts of a motion after `before`.
std::vector<Contacts> ContactsAfter(const Pose& before, const std::vector<Pose>& poses,
                                    const ModelInfo& model) {
  Motion motion{.fps = model.fps, .frames = {before}};
  motion.frames.insert(motion.frames.end(), poses.begin(), poses.end());
  std::vector<Contacts> contacts = DetectContacts(model.skeleton, motion);
  contacts.erase(contacts.begin());
  return contacts;
}

// Corrects footwork part by part, so that other dances need not wait for a long plan's. Parts are
// about equally long, because in a short last one the pelvis would have to move too fast to the
// key.
Slices<> CorrectFootwork(FootworkContext context, Plan* plan) {
  const bool keyed = context.keyed;
  const size_t tau = context.history.size();
  std::vector<Pose> danced(context.history.begin(), context.history.end());
  std::vector<Contacts> contacts;
  for (auto from = plan->poses.begin(); from != plan->poses.end();) {
    co_await Pause();
    const std::ptrdiff_t left = plan->poses.end() - from;
    const std::ptrdiff_t parts = (left + kFootworkFrames - 1) / kFootworkFrames;
    const auto to = from + (left + parts - 1) / parts;
    std::vector<Pose> part(from, to);
    context.history = std::span(danced).last(tau);
    context.keyed = keyed && to == plan->poses.end();
    const Footwork footwork = StandOnFeet(context, &part);
    context.offset_before = footwork.offset;
    danced.insert(danced.end(), part.begin(), part.end());
    contacts.insert(contacts.end(), footwork.contacts.begin(), footwork.contacts.end());
    from = to;
  }
  plan->poses.assign(danced.begin() + std::ssize(danced) - std::ssize(plan->poses), danced.end());
  if (!contacts.empty()) plan->contacts = std::move(contacts);
}

}  // namespace

Slices<ProcessedPlan> ProcessPlan(const ModelInfo& model, const ValidSpec& valid, bool held,
                                  Plan plan) {
  const TransitionSpec& spec = *valid;
  CheckLength(plan, static_cast<size_t>(spec.frames));
  CheckFinite(plan, model, spec.first_frame, "as the model makes it");
  ProcessedPlan processed{std::move(plan)};
  std::vector<Pose>& poses = processed.plan.poses;
  const ControlCurve& path = spec.controls[kRootPath];
  const PlanContext context{.skeleton = model.skeleton,
                            .history = spec.history,
                            .beats = spec.beats,
                            .keyed = Keyed(spec),
                            .has_path = path.IsGiven(),
                            .has_heights = path.IsRequested(kPathHeight),
                            .fps = model.fps,
                            .options = model.plan_options,
                            .noise = spec};
  if (model.plan_stages && !held) {
    for (const auto stage : kPlanStages) stage(context, &poses);
  }

  std::optional<Arrival> arrival =
      ArrivalOf(spec, held ? Arrival::Lead::kAlone : Arrival::Lead::kWithModel);
  if (spec.hit && arrival) HitKey(context, *spec.hit, &poses);
  if (spec.target) {
    processed.raw_error =
        ComparePoses(model.skeleton, poses.back(), spec.target->pose, spec.target->mask);
  }
  for (size_t at = 0; arrival && at < poses.size(); ++at) {
    const Pose proposed = poses[at];
    poses[at] = arrival->Apply(proposed);
    if (poses.size() - at > static_cast<size_t>(arrival->window())) continue;
    const PoseError moved = ComparePoses(model.skeleton, proposed, poses[at], spec.target->mask);
    processed.correction_m = std::max(processed.correction_m, moved.position_m);
  }

  if (spec.footwork && model.plan_stages && !held) KeepArmsOutside(context, &poses);
  if (spec.footwork) {
    const FootworkContext feet{.skeleton = model.skeleton,
                               .history = spec.history,
                               .keyed = arrival.has_value(),
                               .held = held,
                               .has_path = context.has_path,
                               .has_heights = context.has_heights,
                               .fps = model.fps,
                               .options = model.plan_options.footwork};
    co_await CorrectFootwork(feet, &processed.plan);
  }
  if (processed.plan.contacts.empty())
    processed.plan.contacts = ContactsAfter(spec.history.back(), poses, model);
  CheckFinite(processed.plan, model, spec.first_frame, "as arrival and footwork leave it");
  co_return processed;
}

}  // namespace choreo
