#include <algorithm>

#include "client/convert.h"

namespace choreo::client {
namespace {

Error Broken(const std::string& what) {
  return {ErrorCode::kInternal, "", "the server broke the protocol: " + what};
}

KeyReached ToKeyReached(const std::string& id, int64_t frame, const v1::KeyframeErrors& errors) {
  return {id,
          frame,
          errors.raw_error_m(),
          errors.final_error_m(),
          errors.final_error_deg(),
          errors.correction_m()};
}

KeyRejected::Code ToCode(v1::RejectionCode code) {
  switch (code) {
    case v1::REJECTION_CODE_TOO_LATE:
      return KeyRejected::Code::kTooLate;
    case v1::REJECTION_CODE_FROZEN:
      return KeyRejected::Code::kFrozen;
    case v1::REJECTION_CODE_REJECTED_BEFORE:
      return KeyRejected::Code::kRejectedBefore;
    case v1::REJECTION_CODE_ALREADY_DANCED:
      return KeyRejected::Code::kAlreadyDanced;
    default:
      return KeyRejected::Code::kUnknown;
  }
}

Beat::Source ToSource(v1::BeatSource source) {
  switch (source) {
    case v1::BEAT_SOURCE_GIVEN:
      return Beat::Source::kGiven;
    case v1::BEAT_SOURCE_FOUND:
      return Beat::Source::kFound;
    case v1::BEAT_SOURCE_PREDICTED:
      return Beat::Source::kPredicted;
    case v1::BEAT_SOURCE_HEARD:
      return Beat::Source::kHeard;
    default:
      return Beat::Source::kUnknown;
  }
}

}  // namespace

Skeleton FromProto(const v1::Skeleton& skeleton) {
  Skeleton out;
  const int joints = skeleton.parents_size();
  if (skeleton.joint_names_size() != joints || skeleton.offsets_size() != 3 * joints ||
      skeleton.feet_size() != static_cast<int>(out.feet.size())) {
    throw Broken("a skeleton whose arrays differ in length");
  }
  out.name = skeleton.name();
  out.joint_names.assign(skeleton.joint_names().begin(), skeleton.joint_names().end());
  out.parents.assign(skeleton.parents().begin(), skeleton.parents().end());
  out.offsets =
      Eigen::Map<const Eigen::Matrix3Xf>(skeleton.offsets().data(), 3, joints).cast<double>();
  out.AssignRoles();
  out.pelvis_height = skeleton.pelvis_height();
  std::copy(skeleton.feet().begin(), skeleton.feet().end(), out.feet.begin());
  out.Validate();
  return out;
}

Header FromProto(const v1::Header& header) {
  Header out;
  out.model = header.model();
  out.fingerprint = header.fingerprint();
  out.skeleton = FromProto(header.skeleton());
  out.seed = header.seed();
  out.temperature = header.temperature();
  out.fps = header.frame_rate();
  out.model_fps = header.model_frame_rate();
  out.first_frame = header.first_frame();
  out.latency_frames = header.latency_frames();
  out.server_version = header.server_version();
  if (!(out.fps > 0) || !(out.model_fps > 0)) throw Broken("a header without frame rates");
  return out;
}

FrameBlock FromProto(const v1::Frames& frames, int joints) {
  const int count = frames.count();
  if (count < 1 || frames.root_positions_size() != 3 * count ||
      frames.rotations_size() != 3 * count * joints || frames.contacts_size() != 4 * count) {
    throw Broken("frames whose arrays do not have the length that their count asks for");
  }
  FrameBlock out;
  out.first_frame = frames.first_frame();
  out.candidate = frames.candidate();
  out.poses.resize(static_cast<size_t>(count));
  out.contacts.resize(out.poses.size());
  const float* rotations = frames.rotations().data();
  const float* roots = frames.root_positions().data();
  const float* contacts = frames.contacts().data();
  for (size_t i = 0; i < out.poses.size(); ++i) {
    out.poses[i].root_position = Eigen::Map<const Eigen::Vector3f>(roots + 3 * i).cast<double>();
    out.poses[i].rotations = Eigen::Map<const Eigen::Matrix3Xf>(
                                 rotations + 3 * i * static_cast<size_t>(joints), 3, joints)
                                 .cast<double>();
    std::copy_n(contacts + 4 * i, 4, out.contacts[i].begin());
  }
  return out;
}

Continuation FromProto(const v1::Continuation& continuation) {
  return {continuation.frame(), continuation.audio_from_sample(), continuation.fingerprint(),
          continuation.SerializeAsString()};
}

Report FromProto(const v1::QualityReport& report, const v1::Timing& timing) {
  Report out;
  out.frames = report.frames();
  out.measured_from = report.first_frame();
  for (const v1::KeyframeReport& key : report.keyframes()) {
    out.keys.push_back(ToKeyReached(key.id(), key.frame(), key.errors()));
  }
  if (report.has_log_likelihood()) out.log_likelihood = report.log_likelihood();
  if (report.has_beat_hit_rate()) out.beat_hit_rate = report.beat_hit_rate();
  out.skate_ratio = report.skate_ratio();
  if (report.has_support()) out.support = report.support();
  out.max_key_acceleration = report.max_key_acceleration();
  out.p95_acceleration = report.p95_acceleration();
  for (const v1::PartSpeed& speed : report.part_speeds()) {
    const size_t next = out.part_speeds.size();
    if (speed.part() != v1::BODY_PART_TRUNK + static_cast<int>(next))
      throw Broken("speeds of parts of the body in another order");
    out.part_speeds.push_back({speed.asked(), speed.danced()});
  }
  if (!out.part_speeds.empty() && out.part_speeds.size() != kBodyParts)
    throw Broken("speeds of some parts of the body");
  out.first_frame_latency_s = timing.first_frame_latency_s();
  out.elapsed_s = timing.elapsed_s();
  out.real_time_factor = timing.real_time_factor();
  return out;
}

ServerDescription FromProto(const v1::GetServerInfoResponse& response) {
  ServerDescription out;
  out.version = response.version();
  for (const v1::ModelInfo& model : response.models()) {
    ModelDescription& added = out.models.emplace_back();
    added.name = model.name();
    added.fingerprint = model.fingerprint();
    added.licence = model.licence();
    added.card = model.card();
    added.skeleton = FromProto(model.skeleton());
    added.fps = model.model_frame_rate();
    added.history_frames = model.history_frames();
    added.default_temperature = model.default_temperature();
    for (const int control : model.controls()) {
      if (control == v1::CONTROL_ROOT_PATH) added.controls.emplace_back("root_path");
      if (control == v1::CONTROL_VELOCITY_FACTORS) added.controls.emplace_back("velocity_factors");
    }
    for (const v1::VelocityReference& reference : model.velocity_references()) {
      if (reference.speeds_size() != kBodyParts) throw Broken("a velocity reference of odd length");
      added.velocity_references.push_back(
          {reference.name(), {reference.speeds().begin(), reference.speeds().end()}});
    }
    added.styles = {model.styles().begin(), model.styles().end()};
    added.takes_music = !model.takes_no_music();
    added.deterministic = model.deterministic();
    added.likelihood = model.likelihood();
    added.audio_lead_s = model.audio_lead_s();
    added.latency_frames = model.latency_frames();
    // Servers before 0.2 do not tell their models' limits.
    added.max_transition_frames = model.max_transition_frames() > 0
                                      ? model.max_transition_frames()
                                      : response.limits().max_transition_frames();
  }
  if (out.models.empty()) throw Broken("a server without models");
  out.devices.assign(response.devices().begin(), response.devices().end());
  out.workers = response.slots();
  out.active_streams = response.active_streams();
  const v1::Limits& limits = response.limits();
  out.limits = {limits.max_message_bytes(),     limits.max_audio_s(),
                limits.max_audio_file_bytes(),  limits.max_keyframes(),
                limits.max_transition_frames(), limits.max_candidates(),
                limits.max_frame_rate(),        limits.max_streams()};
  return out;
}

std::optional<Message> FromProto(const v1::Event& event) {
  switch (event.event_case()) {
    case v1::Event::kKeyframeReached:
      return ToKeyReached(event.keyframe_reached().id(), event.frame(),
                          event.keyframe_reached().errors());
    case v1::Event::kKeyframeRejected:
      return KeyRejected{
          event.keyframe_rejected().id(), event.frame(), event.keyframe_rejected().earliest_frame(),
          event.keyframe_rejected().reason(), ToCode(event.keyframe_rejected().code())};
    case v1::Event::kBeat:
      return Beat{event.frame(), event.time(), ToSource(event.beat().source()),
                  event.beat().confidence(), event.beat().downbeat()};
    case v1::Event::kWarning:
      return Warning{event.frame(), event.warning().message()};
    case v1::Event::EVENT_NOT_SET:
      break;
  }
  return std::nullopt;
}

}  // namespace choreo::client
