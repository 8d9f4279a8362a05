#include "model/motion/controls/controls.h"
#include "proto/wire/control_messages.h"
#include "proto/wire/convert.h"
#include "proto/wire/field_path.h"

namespace choreo::wire {
namespace {

static_assert(static_cast<int>(KeyRejected::Code::kInvalid) == v1::REJECTION_CODE_INVALID &&
                  static_cast<int>(Beat::Source::kHeard) == v1::BEAT_SOURCE_HEARD &&
                  static_cast<int>(Warning::Code::kBeatsBehindMusic) ==
                      v1::WARNING_CODE_BEATS_BEHIND_MUSIC,
              "codes are numbered alike");

void FillErrors(const KeyReached& key, v1::KeyframeErrors* out) {
  out->set_raw_error_m(key.raw_error_m);
  out->set_final_error_m(key.final_error_m);
  out->set_final_error_deg(key.final_error_deg);
  out->set_correction_m(key.correction_m);
}

// Fills in an event, except its frame and time.
void Fill(const KeyReached& key, v1::Event* out) {
  out->mutable_keyframe_reached()->set_id(key.id);
  FillErrors(key, out->mutable_keyframe_reached()->mutable_errors());
  if (key.hands) out->mutable_keyframe_reached()->set_hands(ToProto(*key.hands));
}

void Fill(const KeyRejected& key, v1::Event* out) {
  v1::KeyframeRejected* rejected = out->mutable_keyframe_rejected();
  rejected->set_id(key.id);
  rejected->set_earliest_frame(key.earliest_frame);
  rejected->set_reason(WithRemedy(key.reason, key.remedy));
  rejected->set_code(static_cast<v1::RejectionCode>(key.code));
  rejected->set_field(key.field);
}

void Fill(const Warning& warning, v1::Event* out) {
  out->mutable_warning()->set_code(static_cast<v1::WarningCode>(warning.code));
  out->mutable_warning()->set_message(warning.message);
  out->mutable_warning()->set_keyframe_id(warning.key_id);
  out->mutable_warning()->set_figure(warning.figure);
  out->mutable_warning()->set_limit(warning.limit);
}

void Fill(const Beat& beat, v1::Event* out) {
  out->set_time(beat.time_s);
  out->mutable_beat()->set_source(static_cast<v1::BeatSource>(beat.source));
  out->mutable_beat()->set_confidence(beat.confidence);
  out->mutable_beat()->set_downbeat(beat.downbeat);
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

v1::MusicPassage ToProto(const Passage& passage) {
  v1::MusicPassage out;
  out.set_from(passage.from);
  out.set_to(passage.to);
  out.set_like(passage.like);
  return out;
}

v1::HandPose ToProto(HandPose hands) {
  return static_cast<v1::HandPose>(v1::HAND_POSE_REST + static_cast<int>(hands));
}

void Write(const DanceManner& manner, google::protobuf::Message* out) {
  const FieldWriter write(out, "");
  DanceManner::VisitSettings(
      [&](const SettingRow& row, const auto& setting) { write(row.name, setting); }, manner);
}

void Write(const KnownMusic& music, v1::DanceConfig* out) {
  KnownMusic::VisitFacts(FieldWriter(out, ""), music);
}

v1::ModelInfo ToProto(const ModelDescription& model) {
  v1::ModelInfo out;
  out.set_name(model.name);
  out.set_fingerprint(model.fingerprint);
  out.set_licence(model.licence);
  out.set_card(model.card);
  *out.mutable_skeleton() = ToProto(model.skeleton);
  out.set_model_frame_rate(model.fps);
  out.set_history_frames(model.history_frames);
  out.set_default_temperature(model.default_temperature);
  for (const std::string& control : model.controls)
    out.add_controls(static_cast<v1::Control>(FindControl(control) + 1));
  out.set_audio_lead_s(model.audio_lead_s);
  out.set_latency_frames(model.latency_frames);
  out.set_max_transition_frames(model.max_transition_frames);
  for (const auto& [name, speeds] : model.velocity_references) {
    v1::VelocityReference* added = out.add_velocity_references();
    added->set_name(name);
    added->mutable_speeds()->Add(speeds.begin(), speeds.end());
  }
  out.set_takes_no_music(!model.takes_music);
  out.set_deterministic(model.deterministic);
  out.mutable_styles()->Add(model.styles.begin(), model.styles.end());
  out.set_likelihood(model.likelihood);
  if (model.style_figures) {
    v1::StyleRecognition& styles = *out.mutable_style_recognition();
    styles.set_recognised_percent(model.style_figures->recognised);
    styles.set_chance_percent(model.style_figures->chance);
    styles.set_low_percent(model.style_figures->low);
    styles.set_shows(model.style_figures->shows());
  }
  return out;
}

v1::Header ToProto(const DanceHeader& header) {
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
  out.set_exact_resume(header.exact_resume);
  out.set_free_transition_frames(header.free_transition_frames);
  out.set_server_version(header.server_version);
  return out;
}

v1::QualityReport ToProto(const QualityReport& report) {
  v1::QualityReport out;
  out.set_first_frame(report.measured_from);
  out.set_frames(report.frames);
  for (const KeyReached& key : report.keys) {
    v1::KeyframeReport* added = out.add_keyframes();
    added->set_id(key.id);
    added->set_frame(key.frame);
    FillErrors(key, added->mutable_errors());
    added->set_max_acceleration(key.max_acceleration);
  }
  if (report.log_likelihood) out.set_log_likelihood(*report.log_likelihood);
  out.set_skate_ratio(report.skate_ratio);
  if (report.support) out.set_support(*report.support);
  if (report.beat_hit_rate) out.set_beat_hit_rate(*report.beat_hit_rate);
  if (report.beat_coverage) out.set_beat_coverage(*report.beat_coverage);
  out.set_max_key_acceleration(report.max_key_acceleration);
  for (const PartSpeed& speed : report.part_speeds) {
    v1::PartSpeed* added = out.add_part_speeds();
    added->set_part(static_cast<v1::BodyPart>(out.part_speeds_size()));
    added->set_asked(speed.asked);
    added->set_danced(speed.danced);
  }
  out.set_p95_acceleration(report.p95_acceleration);
  return out;
}

v1::Timing ToProto(const CallTiming& timing) {
  v1::Timing out;
  out.set_first_frame_latency_s(timing.first_frame_latency_s);
  out.set_elapsed_s(timing.elapsed_s);
  out.set_real_time_factor(timing.real_time_factor);
  return out;
}

v1::Event ToProto(const DanceEvent& event, double fps) {
  v1::Event out;
  std::visit(
      [&](const auto& said) {
        out.set_frame(said.frame);
        out.set_time(static_cast<double>(said.frame) / fps);
        Fill(said, &out);
      },
      event);
  return out;
}

}  // namespace choreo::wire
