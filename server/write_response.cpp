#include "server/write_response.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/audio/format.h"
#include "model/dance/transition.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

void FillErrors(const ArrivalResult& arrival, v1::KeyframeErrors* out) {
  out->set_raw_error_m(arrival.raw_error_m);
  out->set_final_error_m(arrival.final_error_m);
  out->set_final_error_deg(arrival.final_error_deg);
  out->set_correction_m(arrival.correction_m);
}

v1::RejectionCode ToCode(KeyRejection::Why why) {
  switch (why) {
    case KeyRejection::Why::kTooLate:
      return v1::REJECTION_CODE_TOO_LATE;
    case KeyRejection::Why::kFrozen:
      return v1::REJECTION_CODE_FROZEN;
    case KeyRejection::Why::kRejectedBefore:
      return v1::REJECTION_CODE_REJECTED_BEFORE;
    case KeyRejection::Why::kAlreadyDanced:
      return v1::REJECTION_CODE_ALREADY_DANCED;
  }
  return v1::REJECTION_CODE_UNSPECIFIED;
}

v1::WarningCode ToCode(DanceWarning::Kind kind) {
  switch (kind) {
    case DanceWarning::Kind::kIntervalTooShort:
      return v1::WARNING_CODE_INTERVAL_TOO_SHORT;
    case DanceWarning::Kind::kInexactResume:
      return v1::WARNING_CODE_INEXACT_RESUME;
    case DanceWarning::Kind::kPathTooFast:
      return v1::WARNING_CODE_PATH_TOO_FAST;
    case DanceWarning::Kind::kKeyOffPath:
      return v1::WARNING_CODE_KEY_OFF_PATH;
    case DanceWarning::Kind::kPathBehindEnd:
      return v1::WARNING_CODE_PATH_BEHIND_END;
    case DanceWarning::Kind::kKeyOffHeight:
      return v1::WARNING_CODE_KEY_OFF_HEIGHT;
    case DanceWarning::Kind::kPathAway:
      return v1::WARNING_CODE_PATH_AWAY;
    case DanceWarning::Kind::kBeatsTooLate:
      return v1::WARNING_CODE_BEATS_TOO_LATE;
    case DanceWarning::Kind::kTemperatureTooHigh:
      return v1::WARNING_CODE_TEMPERATURE_TOO_HIGH;
    case DanceWarning::Kind::kVelocityNotMet:
      return v1::WARNING_CODE_VELOCITY_NOT_MET;
    case DanceWarning::Kind::kControlsTooLate:
      return v1::WARNING_CODE_CONTROLS_TOO_LATE;
  }
  return v1::WARNING_CODE_UNSPECIFIED;
}

v1::BeatSource ToSource(MusicBeat::Source source) {
  switch (source) {
    case MusicBeat::Source::kGiven:
      return v1::BEAT_SOURCE_GIVEN;
    case MusicBeat::Source::kFound:
      return v1::BEAT_SOURCE_FOUND;
    case MusicBeat::Source::kPredicted:
      return v1::BEAT_SOURCE_PREDICTED;
    case MusicBeat::Source::kHeard:
      return v1::BEAT_SOURCE_HEARD;
  }
  return v1::BEAT_SOURCE_UNSPECIFIED;
}

}  // namespace

void FromSkeleton(const Skeleton& skeleton, v1::Skeleton* out) {
  out->set_name(skeleton.name);
  for (const auto& name : skeleton.joint_names) out->add_joint_names(name);
  for (const int parent : skeleton.parents) out->add_parents(parent);
  for (const double value : skeleton.offsets.reshaped()) {
    out->add_offsets(static_cast<float>(value));
  }
  out->set_pelvis_height(skeleton.pelvis_height);
  for (const int joint : skeleton.feet) out->add_feet(joint);
}

void FromFrames(int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts> contacts, v1::RotationEncoding encoding,
                v1::Frames* out) {
  out->set_first_frame(first_frame);
  out->set_count(static_cast<int32_t>(poses.size()));
  auto add = [out](double value) { out->add_rotations(static_cast<float>(value)); };
  for (const Pose& pose : poses) {
    for (const double value : pose.root_position) {
      out->add_root_positions(static_cast<float>(value));
    }
    for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
      const Eigen::Vector3d w = pose.rotations.col(joint);
      if (encoding == v1::ROTATION_ENCODING_QUATERNION) {
        for (const double value : QuaternionFromExp(w).coeffs()) add(value);
      } else if (encoding == v1::ROTATION_ENCODING_MATRIX) {
        const Eigen::Matrix3d r = ExpMap(w);
        for (int i = 0; i < 9; ++i) add(r(i / 3, i % 3));
      } else {
        for (const double value : w) add(value);
      }
    }
  }
  for (const auto& frame : contacts) {
    for (const float value : frame) out->add_contacts(value);
  }
}

void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out) {
  out->set_frame(continuation.frame);
  if (audio_format != nullptr && audio_format->encoding() != v1::AUDIO_ENCODING_FILE)
    out->set_audio_from_sample(continuation.audio_from_sample.value_or(0));
  out->set_fingerprint(continuation.fingerprint);
  out->set_seed(seed);
  for (const Pose& pose : continuation.poses) {
    for (const double value : pose.root_position) {
      out->add_root_positions(static_cast<float>(value));
    }
    for (const double value : pose.rotations.reshaped()) {
      out->add_rotations(static_cast<float>(value));
    }
  }
  out->set_skeleton(model.skeleton.name);
  if (continuation.last_beat) out->set_last_beat(*continuation.last_beat);
  if (continuation.stage) {
    out->add_stage(static_cast<float>(continuation.stage->x()));
    out->add_stage(static_cast<float>(continuation.stage->z()));
  }
}

void FromReport(const QualityReport& report, v1::QualityReport* out) {
  out->set_first_frame(report.first_frame);
  out->set_frames(report.frames);
  for (const KeyReport& key : report.keys) {
    auto* entry = out->add_keyframes();
    entry->set_id(key.id);
    entry->set_frame(key.frame);
    FillErrors(key.arrival, entry->mutable_errors());
    entry->set_max_acceleration(key.max_acceleration);
  }
  if (report.mean_log_likelihood) out->set_log_likelihood(*report.mean_log_likelihood);
  out->set_skate_ratio(report.skate_ratio);
  if (report.support) out->set_support(*report.support);
  if (report.beat_hit_rate) out->set_beat_hit_rate(*report.beat_hit_rate);
  if (report.beat_coverage) out->set_beat_coverage(*report.beat_coverage);
  out->set_max_key_acceleration(report.max_key_acceleration);
  if (report.part_speeds) {
    for (int part = 0; part < kBodyParts; ++part) {
      const PartSpeed& speed = (*report.part_speeds)[static_cast<size_t>(part)];
      auto* entry = out->add_part_speeds();
      entry->set_part(static_cast<v1::BodyPart>(part + 1));
      entry->set_asked(speed.asked);
      entry->set_danced(speed.danced);
    }
  }
  out->set_p95_acceleration(report.p95_acceleration);
}

void FromEvent(const DanceEvent& event, double fps, v1::Event* out) {
  if (const auto* beat = std::get_if<MusicBeat>(&event)) {
    out->set_frame(beat->frame);
    out->set_time(beat->seconds);
    out->mutable_beat()->set_source(ToSource(beat->source));
    out->mutable_beat()->set_confidence(beat->confidence);
    out->mutable_beat()->set_downbeat(beat->downbeat);
    return;
  }
  if (const auto* reached = std::get_if<KeyReached>(&event)) {
    out->set_frame(reached->frame);
    out->mutable_keyframe_reached()->set_id(reached->id);
    FillErrors(reached->arrival, out->mutable_keyframe_reached()->mutable_errors());
  } else if (const auto* rejection = std::get_if<KeyRejection>(&event)) {
    out->set_frame(rejection->frame);
    auto* rejected = out->mutable_keyframe_rejected();
    rejected->set_id(rejection->id);
    rejected->set_earliest_frame(rejection->earliest_frame);
    rejected->set_reason(rejection->reason);
    rejected->set_code(ToCode(rejection->why));
  } else if (const auto* warning = std::get_if<DanceWarning>(&event)) {
    out->set_frame(warning->frame);
    out->mutable_warning()->set_code(ToCode(warning->kind));
    out->mutable_warning()->set_message(warning->message);
  }
  out->set_time(static_cast<double>(out->frame()) / fps);
}

void FromModel(const ModelInfo& model, v1::ModelInfo* out) {
  out->set_name(model.name);
  out->set_fingerprint(model.fingerprint);
  out->set_licence(model.licence);
  out->set_card(model.card);
  FromSkeleton(model.skeleton, out->mutable_skeleton());
  out->set_model_frame_rate(model.fps);
  out->set_history_frames(model.history_frames);
  out->set_default_temperature(model.default_temperature);
  out->set_max_transition_frames(std::min(model.max_transition_frames, kMaxTransitionFrames));
  if (model.root_path) out->add_controls(v1::CONTROL_ROOT_PATH);
  if (model.velocity_factors) out->add_controls(v1::CONTROL_VELOCITY_FACTORS);
  for (const VelocityReference& reference : model.velocity_references) {
    v1::VelocityReference* added = out->add_velocity_references();
    added->set_name(reference.name);
    added->mutable_speeds()->Add(reference.factors.begin(), reference.factors.end());
  }
  out->set_deterministic(model.deterministic);
  out->set_likelihood(model.likelihood);
  out->mutable_styles()->Add(model.styles.begin(), model.styles.end());
  out->set_takes_no_music(!TakesMusic(model));
  if (out->takes_no_music()) return;
  // The lowest rate has the longest filter. Any frame far enough from the start shows the lead.
  constexpr int64_t kSomeFrame = 3'000;
  out->set_audio_lead_s(static_cast<double>(kSomeFrame) / model.fps -
                        static_cast<double>(LatestFirstSample(kSomeFrame, kMinSampleRate, model)) /
                            kMinSampleRate);
  DanceConfig config;
  config.output_fps = model.fps;
  config.audio = DanceConfig::Audio{kMinSampleRate, 1, 0};
  out->set_latency_frames(DanceStream::LatencyFrames(config, model));
}

}  // namespace choreo
