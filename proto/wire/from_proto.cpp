#include <algorithm>
#include <iterator>

#include "model/core/error.h"
#include "model/motion/controls/controls.h"
#include "model/motion/controls/velocity_factors.h"
#include "proto/wire/control_messages.h"
#include "proto/wire/convert.h"

namespace choreo::wire {
namespace {

KeyReached ToKeyReached(const std::string& id, int64_t frame, const v1::KeyframeErrors& errors) {
  return {.id = id,
          .frame = frame,
          .raw_error_m = errors.raw_error_m(),
          .final_error_m = errors.final_error_m(),
          .final_error_deg = errors.final_error_deg(),
          .correction_m = errors.correction_m()};
}

/// kUnknown for codes above `last`, the greatest that this version knows.
template <typename Code>
Code ToCode(int number, Code last) {
  return number > 0 && number <= static_cast<int>(last) ? static_cast<Code>(number)
                                                        : Code::kUnknown;
}

}  // namespace

Error Broken(const std::string& what) {
  return {ErrorCode::kInternal, "", "the server broke the protocol: " + what};
}

DanceManner MannerOf(const google::protobuf::Message& message) {
  DanceManner manner;
  const FieldReader read(message, "");
  DanceManner::VisitSettings([&](const SettingRow& row, auto& setting) { read(row.name, setting); },
                             manner);
  return manner;
}

KnownMusic MusicOf(const v1::DanceConfig& config) {
  KnownMusic music;
  KnownMusic::VisitFacts(FieldReader(config, ""), music);
  return music;
}

Passage FromProto(const v1::MusicPassage& passage) {
  return {passage.from(), passage.to(), passage.like()};
}

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
  out.Check();
  return out;
}

std::optional<HandPose> FromProto(v1::HandPose hands) {
  const int pose = hands - v1::HAND_POSE_REST;
  if (pose < 0 || pose >= std::ssize(kHandPoseNames)) return std::nullopt;
  return static_cast<HandPose>(pose);
}

ModelDescription FromProto(const v1::ModelInfo& model) {
  ModelDescription out;
  out.name = model.name();
  out.fingerprint = model.fingerprint();
  out.licence = model.licence();
  out.card = model.card();
  out.skeleton = FromProto(model.skeleton());
  out.fps = model.model_frame_rate();
  out.history_frames = model.history_frames();
  out.default_temperature = model.default_temperature();
  for (const int control : model.controls()) {
    // A newer server may have more.
    if (control >= 1 && control <= std::ssize(kControls))
      out.controls.emplace_back(kControls[control - 1].name);
  }
  for (const v1::VelocityReference& reference : model.velocity_references()) {
    if (reference.speeds_size() != kBodyParts) throw Broken("a velocity reference of odd length");
    VelocityReference& added = out.velocity_references.emplace_back();
    added.name = reference.name();
    std::ranges::copy(reference.speeds(), added.speeds.begin());
  }
  out.styles = {model.styles().begin(), model.styles().end()};
  out.takes_music = !model.takes_no_music();
  out.likelihood = model.likelihood();
  if (model.has_style_recognition()) {
    const v1::StyleRecognition& styles = model.style_recognition();
    out.style_figures = {styles.recognised_percent(), styles.chance_percent(),
                         styles.low_percent()};
  }
  out.deterministic = model.deterministic();
  out.audio_lead_s = model.audio_lead_s();
  out.latency_frames = model.latency_frames();
  out.max_transition_frames = model.max_transition_frames();
  return out;
}

DanceHeader FromProto(const v1::Header& header) {
  DanceHeader out;
  out.model = header.model();
  out.fingerprint = header.fingerprint();
  out.skeleton = FromProto(header.skeleton());
  out.seed = header.seed();
  out.temperature = header.temperature();
  out.fps = header.frame_rate();
  out.model_fps = header.model_frame_rate();
  out.first_frame = header.first_frame();
  out.latency_frames = header.latency_frames();
  out.exact_resume = header.exact_resume();
  out.free_transition_frames = header.free_transition_frames();
  out.server_version = header.server_version();
  if (!(out.fps > 0) || !(out.model_fps > 0)) throw Broken("a header without frame rates");
  return out;
}

QualityReport FromProto(const v1::QualityReport& report) {
  QualityReport out;
  out.frames = report.frames();
  out.measured_from = report.first_frame();
  for (const v1::KeyframeReport& key : report.keyframes()) {
    out.keys.push_back(ToKeyReached(key.id(), key.frame(), key.errors()));
    out.keys.back().max_acceleration = key.max_acceleration();
  }
  if (report.has_log_likelihood()) out.log_likelihood = report.log_likelihood();
  out.skate_ratio = report.skate_ratio();
  if (report.has_support()) out.support = report.support();
  if (report.has_beat_hit_rate()) out.beat_hit_rate = report.beat_hit_rate();
  if (report.has_beat_coverage()) out.beat_coverage = report.beat_coverage();
  out.max_key_acceleration = report.max_key_acceleration();
  out.p95_acceleration = report.p95_acceleration();
  for (const v1::PartSpeed& speed : report.part_speeds()) {
    if (speed.part() != v1::BODY_PART_TRUNK + static_cast<int>(out.part_speeds.size()))
      throw Broken("speeds of parts of the body in another order");
    out.part_speeds.push_back({speed.asked(), speed.danced()});
  }
  if (!out.part_speeds.empty() && out.part_speeds.size() != kBodyParts)
    throw Broken("speeds of some parts of the body");
  return out;
}

CallTiming FromProto(const v1::Timing& timing) {
  return {timing.first_frame_latency_s(), timing.elapsed_s(), timing.real_time_factor()};
}

std::optional<DanceEvent> FromProto(const v1::Event& event) {
  const int64_t frame = event.frame();
  switch (event.event_case()) {
    case v1::Event::kKeyframeReached: {
      const v1::KeyframeReached& key = event.keyframe_reached();
      KeyReached reached = ToKeyReached(key.id(), frame, key.errors());
      reached.hands = FromProto(key.hands());
      return reached;
    }
    case v1::Event::kKeyframeRejected: {
      const v1::KeyframeRejected& key = event.keyframe_rejected();
      return KeyRejected{key.id(),
                         frame,
                         key.earliest_frame(),
                         key.reason(),
                         ToCode(key.code(), KeyRejected::Code::kInvalid),
                         key.field()};
    }
    case v1::Event::kBeat: {
      const v1::Beat& beat = event.beat();
      return Beat{frame, event.time(), ToCode(beat.source(), Beat::Source::kHeard),
                  beat.confidence(), beat.downbeat()};
    }
    case v1::Event::kWarning:
      return Warning{frame,
                     event.warning().message(),
                     ToCode(event.warning().code(), Warning::Code::kBeatsBehindMusic),
                     event.warning().keyframe_id(),
                     event.warning().figure(),
                     event.warning().limit()};
    case v1::Event::EVENT_NOT_SET:
      break;
  }
  return std::nullopt;
}

}  // namespace choreo::wire
