#include "studio/convert.h"

#include <algorithm>

#include "client/convert.h"
#include "model/motion/pose_limits.h"

namespace choreo::studio {
namespace {

constexpr double kWholeTurn = 2 * M_PI;

void RequireCount(const std::string& field, int count, int wanted) {
  if (count == wanted) return;
  throw InvalidArgument(field,
                        std::to_string(count) + " numbers, must be " + std::to_string(wanted));
}

Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field,
            double max_rotation) {
  if (pose.encoding() > v1::ROTATION_ENCODING_AXIS_ANGLE)
    throw InvalidArgument(field + ".encoding", "must be axis-angle");
  RequireCount(field + ".rotations", pose.rotations_size(), 3 * skeleton.joints());
  Pose out;
  const v1::Vector3& root = pose.root_position();
  out.root_position = {root.x(), root.y(), root.z()};
  out.rotations = Eigen::Map<const Eigen::Matrix3Xf>(pose.rotations().data(), 3, skeleton.joints())
                      .cast<double>();
  CheckPoseLimits(out, max_rotation, "the limit", field);
  return out;
}

PoseMask ToMask(const v1::JointMask* joints, bool root_position, const Skeleton& skeleton,
                const std::string& field) {
  PoseMask mask;
  mask.root_position = root_position;
  if (!joints) return mask;
  mask.joints.assign(static_cast<size_t>(skeleton.joints()), false);
  for (const int joint : joints->joints()) {
    if (joint < 0 || joint >= skeleton.joints()) {
      throw InvalidArgument(field, "joint " + std::to_string(joint) + ", must be 0 to " +
                                       std::to_string(skeleton.joints() - 1));
    }
    mask.joints[static_cast<size_t>(joint)] = true;
  }
  return mask;
}

v1::Frames ToFrames(const client::FrameBlock& block) {
  v1::Frames out;
  out.set_first_frame(block.first_frame);
  out.set_count(static_cast<int>(block.poses.size()));
  out.set_candidate(block.candidate);
  for (const Pose& pose : block.poses) {
    for (const double value : pose.root_position) out.add_root_positions(static_cast<float>(value));
    for (const double value : pose.rotations.reshaped())
      out.add_rotations(static_cast<float>(value));
  }
  for (const auto& contacts : block.contacts)
    out.mutable_contacts()->Add(contacts.begin(), contacts.end());
  return out;
}

v1::Header ToHeader(const client::Header& header) {
  v1::Header out;
  out.set_model(header.model);
  out.set_fingerprint(header.fingerprint);
  *out.mutable_skeleton() = ToProto(header.skeleton);
  out.set_seed(header.seed);
  out.set_temperature(header.temperature);
  out.set_frame_rate(header.fps);
  out.set_model_frame_rate(header.model_fps);
  out.set_encoding(v1::ROTATION_ENCODING_AXIS_ANGLE);
  out.set_first_frame(header.first_frame);
  out.set_latency_frames(header.latency_frames);
  out.set_exact_resume(true);
  out.set_server_version(header.server_version);
  return out;
}

v1::KeyframeErrors ToErrors(const client::KeyReached& reached) {
  v1::KeyframeErrors out;
  out.set_raw_error_m(reached.raw_error_m);
  out.set_final_error_m(reached.final_error_m);
  out.set_final_error_deg(reached.final_error_deg);
  out.set_correction_m(reached.correction_m);
  return out;
}

v1::QualityReport ToReport(const client::Report& report) {
  v1::QualityReport out;
  out.set_first_frame(report.measured_from);
  out.set_frames(report.frames);
  for (const client::KeyReached& key : report.keys) {
    v1::KeyframeReport* added = out.add_keyframes();
    added->set_id(key.id);
    added->set_frame(key.frame);
    *added->mutable_errors() = ToErrors(key);
  }
  out.set_log_likelihood(report.log_likelihood);
  out.set_skate_ratio(report.skate_ratio);
  if (report.beat_hit_rate) out.set_beat_hit_rate(*report.beat_hit_rate);
  out.set_max_key_acceleration(report.max_key_acceleration);
  out.set_p95_acceleration(report.p95_acceleration);
  for (size_t part = 0; part < report.part_speeds.size(); ++part) {
    v1::PartSpeed* speed = out.add_part_speeds();
    speed->set_part(static_cast<v1::BodyPart>(v1::BODY_PART_TRUNK + static_cast<int>(part)));
    speed->set_asked(report.part_speeds[part].asked);
    speed->set_danced(report.part_speeds[part].danced);
  }
  return out;
}

v1::Continuation ToContinuation(const client::Continuation& continuation) {
  v1::Continuation out;
  if (!out.ParseFromString(continuation.bytes))
    throw Error(ErrorCode::kInternal, "continuation", "cannot be read");
  return out;
}

v1::Event WarningEvent(const client::Warning& warning) {
  v1::Event out;
  out.set_frame(warning.frame);
  out.mutable_warning()->set_message(warning.message);
  return out;
}

}  // namespace

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton) {
  client::KeyPose out;
  out.id = key.id();
  switch (key.when_case()) {
    case v1::Keyframe::kFrame:
      out.frame = key.frame();
      break;
    case v1::Keyframe::kTime:
      out.time_s = key.time();
      break;
    default:
      throw InvalidArgument("keyframe.when", "must be a frame or a time");
  }
  out.pose = ToPose(key.pose(), skeleton, "keyframe.pose", kWholeTurn);
  out.mask = ToMask(key.has_mask() ? &key.mask() : nullptr, key.pose().has_root_position(),
                    skeleton, "keyframe.mask.joints");
  return out;
}

client::Controls FromProto(const v1::Controls& controls) {
  client::Controls out;
  if (controls.has_root_path()) {
    const v1::RootPath& path = controls.root_path();
    client::Controls::RootPath& added = out.root_path.emplace();
    added.frames.assign(path.frames().begin(), path.frames().end());
    RequireCount("root_path.points", path.points_size(), 2 * path.frames_size());
    for (int i = 0; i < path.points_size(); i += 2)
      added.points.emplace_back(path.points(i), path.points(i + 1));
    added.heights.assign(path.heights().begin(), path.heights().end());
  }
  if (controls.has_velocity_factors()) {
    const v1::VelocityFactors& velocity = controls.velocity_factors();
    client::Controls::VelocityFactors& added = out.velocity_factors.emplace();
    added.frames.assign(velocity.frames().begin(), velocity.frames().end());
    added.factors.assign(velocity.factors().begin(), velocity.factors().end());
    added.speeds.assign(velocity.speeds().begin(), velocity.speeds().end());
    added.reference = velocity.reference();
    for (const int part : velocity.parts()) {
      if (part < v1::BODY_PART_TRUNK || part > v1::BODY_PART_RIGHT_LEG)
        throw InvalidArgument("velocity_factors.parts", std::to_string(part) + " is no part");
      added.parts.emplace_back(kBodyPartNames[static_cast<size_t>(part - v1::BODY_PART_TRUNK)]);
    }
  }
  return out;
}

client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton) {
  client::DanceConfig out;
  const auto refuse = [](const char* field) {
    throw InvalidArgument(field, "must be absent: the studio sees to it");
  };
  if (!config.model().empty()) refuse("config.model");
  if (config.has_audio_format()) refuse("config.audio_format");
  if (config.music_beats_size() > 0) refuse("config.music_beats");
  if (config.frame_rate() != 0) refuse("config.frame_rate");
  if (config.has_seed()) out.seed = config.seed();
  if (config.has_temperature()) out.temperature = config.temperature();
  if (config.has_frames()) out.frames = config.frames();
  for (int i = 0; i < config.history().poses_size(); ++i) {
    out.history.push_back(ToPose(config.history().poses(i), skeleton,
                                 "config.history.poses[" + std::to_string(i) + "]",
                                 kMaxWoundRotation));
  }
  out.first_frame = config.history().first_frame();
  if (config.has_continuation()) out.continuation = client::FromProto(config.continuation());
  // A file's rotations may have gone round more than once; what is sent takes the shortest way.
  const Pose unturned{{}, Eigen::Matrix3Xd::Zero(3, skeleton.joints())};
  for (Pose& pose : out.history) MakeContinuous(pose, unturned);
  return out;
}

client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton) {
  client::TransitionRequest out;
  out.config = FromProto(request.config(), skeleton);
  out.config.controls = FromProto(request.controls());
  out.frames = request.frames();
  if (request.has_audio()) throw InvalidArgument("audio", "must be absent: the studio sees to it");
  const Pose unturned{{}, Eigen::Matrix3Xd::Zero(3, skeleton.joints())};
  if (request.has_target()) {
    out.target = ToPose(request.target(), skeleton, "target", kMaxWoundRotation);
    MakeContinuous(*out.target, unturned);
    out.target_mask = ToMask(request.has_target_mask() ? &request.target_mask() : nullptr,
                             request.target().has_root_position(), skeleton, "target_mask.joints");
  }
  out.target_id = request.target_id();
  for (int i = 0; i < request.after_size(); ++i) {
    out.after.push_back(
        ToPose(request.after(i), skeleton, "after[" + std::to_string(i) + "]", kMaxWoundRotation));
    MakeContinuous(out.after.back(), unturned);
  }
  out.candidates = static_cast<int>(std::max(1U, request.candidates()));
  return out;
}

client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton) {
  const v1::Frames& frames = clip.frames();
  const int count = frames.count();
  if (count < 1) throw InvalidArgument("clip.frames", "there are none");
  RequireCount("clip.frames.root_positions", frames.root_positions_size(), 3 * count);
  RequireCount("clip.frames.rotations", frames.rotations_size(), 3 * count * skeleton.joints());
  if (!(clip.frame_rate() >= 1 && clip.frame_rate() <= 1000))
    throw InvalidArgument("clip.frame_rate", "must be 1 to 1000");
  v1::Frames whole = frames;
  const bool touches = frames.contacts_size() > 0;
  if (!touches) whole.mutable_contacts()->Resize(4 * count, 0);
  client::FrameBlock block = client::FromProto(whole, skeleton.joints());
  client::FinishedDance out;
  out.motion = {.fps = clip.frame_rate(), .frames = std::move(block.poses)};
  if (touches) out.contacts = std::move(block.contacts);
  CheckMotionLimits(out.motion);
  return out;
}

v1::Skeleton ToProto(const Skeleton& skeleton) {
  v1::Skeleton out;
  out.set_name(skeleton.name);
  out.mutable_joint_names()->Add(skeleton.joint_names.begin(), skeleton.joint_names.end());
  out.mutable_parents()->Add(skeleton.parents.begin(), skeleton.parents.end());
  for (const double value : skeleton.offsets.reshaped()) out.add_offsets(static_cast<float>(value));
  out.set_pelvis_height(skeleton.pelvis_height);
  out.mutable_feet()->Add(skeleton.feet.begin(), skeleton.feet.end());
  return out;
}

v1::ModelInfo ToProto(const client::ModelDescription& model) {
  v1::ModelInfo out;
  out.set_name(model.name);
  out.set_fingerprint(model.fingerprint);
  out.set_licence(model.licence);
  *out.mutable_skeleton() = ToProto(model.skeleton);
  out.set_model_frame_rate(model.fps);
  out.set_history_frames(model.history_frames);
  out.set_default_temperature(model.default_temperature);
  for (const std::string& control : model.controls) {
    if (control == "root_path") out.add_controls(v1::CONTROL_ROOT_PATH);
    if (control == "velocity_factors") out.add_controls(v1::CONTROL_VELOCITY_FACTORS);
  }
  out.set_max_transition_frames(model.max_transition_frames);
  out.set_takes_no_music(!model.takes_music);
  out.set_deterministic(model.deterministic);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Header& header) {
  v1::StreamDanceResponse out;
  *out.mutable_header() = ToHeader(header);
  return out;
}

v1::StreamDanceResponse ToProto(const client::FrameBlock& block) {
  v1::StreamDanceResponse out;
  *out.mutable_frames() = ToFrames(block);
  return out;
}

v1::StreamDanceResponse ToProto(const client::KeyReached& reached) {
  v1::StreamDanceResponse out;
  out.mutable_event()->set_frame(reached.frame);
  out.mutable_event()->mutable_keyframe_reached()->set_id(reached.id);
  *out.mutable_event()->mutable_keyframe_reached()->mutable_errors() = ToErrors(reached);
  return out;
}

v1::StreamDanceResponse ToProto(const client::KeyRejected& rejected) {
  v1::StreamDanceResponse out;
  out.mutable_event()->set_frame(rejected.frame);
  v1::KeyframeRejected* event = out.mutable_event()->mutable_keyframe_rejected();
  event->set_id(rejected.id);
  event->set_earliest_frame(rejected.earliest_frame);
  event->set_reason(rejected.reason);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Beat& beat) {
  v1::StreamDanceResponse out;
  out.mutable_event()->set_frame(beat.frame);
  out.mutable_event()->set_time(beat.time_s);
  out.mutable_event()->mutable_beat();
  return out;
}

v1::StreamDanceResponse ToProto(const client::Warning& warning) {
  v1::StreamDanceResponse out;
  *out.mutable_event() = WarningEvent(warning);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Continuation& continuation) {
  v1::StreamDanceResponse out;
  *out.mutable_continuation() = ToContinuation(continuation);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Report& report) {
  v1::StreamDanceResponse out;
  *out.mutable_summary()->mutable_report() = ToReport(report);
  v1::Timing* timing = out.mutable_summary()->mutable_timing();
  timing->set_first_frame_latency_s(report.first_frame_latency_s);
  timing->set_elapsed_s(report.elapsed_s);
  timing->set_real_time_factor(report.real_time_factor);
  return out;
}

std::vector<v1::GenerateTransitionResponse> ToProto(const client::TransitionResult& result) {
  std::vector<v1::GenerateTransitionResponse> out(1);
  *out.back().mutable_header() = ToHeader(result.header);
  for (const client::Warning& warning : result.warnings)
    *out.emplace_back().mutable_event() = WarningEvent(warning);
  v1::GenerateTransitionResponse summary;
  for (const client::TransitionCandidate& candidate : result.candidates) {
    *out.emplace_back().mutable_frames() =
        ToFrames({.first_frame = candidate.continuation.frame -
                                 static_cast<int64_t>(candidate.motion.frames.size()),
                  .poses = candidate.motion.frames,
                  .contacts = candidate.contacts,
                  .candidate = candidate.candidate});
    v1::Candidate* added = summary.mutable_summary()->add_candidates();
    added->set_candidate(candidate.candidate);
    *added->mutable_report() = ToReport(candidate.report);
    *added->mutable_continuation() = ToContinuation(candidate.continuation);
  }
  out.push_back(std::move(summary));
  return out;
}

Clip ToProto(const client::FinishedDance& dance) {
  Clip out;
  out.set_frame_rate(dance.motion.fps);
  *out.mutable_frames() =
      ToFrames({.first_frame = 0, .poses = dance.motion.frames, .contacts = dance.contacts});
  return out;
}

}  // namespace choreo::studio
