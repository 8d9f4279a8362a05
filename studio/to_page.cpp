#include "studio/to_page.h"

namespace choreo::studio {
namespace {

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
  if (report.log_likelihood) out.set_log_likelihood(*report.log_likelihood);
  out.set_skate_ratio(report.skate_ratio);
  if (report.support) out.set_support(*report.support);
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
  out.mutable_styles()->Add(model.styles.begin(), model.styles.end());
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

static_assert(static_cast<int>(client::KeyRejected::Code::kAlreadyDanced) ==
                  v1::REJECTION_CODE_ALREADY_DANCED,
              "codes are numbered alike");

v1::StreamDanceResponse ToProto(const client::KeyRejected& rejected) {
  v1::StreamDanceResponse out;
  out.mutable_event()->set_frame(rejected.frame);
  v1::KeyframeRejected* event = out.mutable_event()->mutable_keyframe_rejected();
  event->set_id(rejected.id);
  event->set_earliest_frame(rejected.earliest_frame);
  event->set_reason(rejected.reason);
  event->set_code(static_cast<v1::RejectionCode>(rejected.code));
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
