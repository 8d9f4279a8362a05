#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "choreo/v1/choreography.pb.h"
#include "choreo/v1/motion.pb.h"
#include "model/dance/dance_stream.h"
#include "model/dance/transition_group.h"
#include "model/engine/step_engine.h"

/// Messages of the API <-> the dance's own types. On the way in everything is checked that the
/// message alone can tell; failures are Error with the path of the field, beginning with `field`.
/// Pure functions, thread-safe.
namespace choreo {

inline constexpr int64_t kMaxMessageBytes = 16 << 20;
inline constexpr int64_t kMaxAudioFileBytes = 128 << 20;
/// Music of a file is handed to a stream at the features' own rate: its format is not known before
/// the file has come.
inline constexpr double kFileAudioRate = 22'050;

// ---- in

/// Joint rotations in any encoding -> axis-angle, [3, joints].
Eigen::Matrix3Xd ToRotations(const v1::Pose& pose, const Skeleton& skeleton,
                             const std::string& field);

/// A pose whose root position is required.
Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field);

/// A key pose and what it asks for. `mask` null: all joints.
WorldTarget ToTarget(const v1::Pose& pose, const v1::JointMask* mask, const Skeleton& skeleton,
                     const std::string& pose_field, const std::string& mask_field);

KeyMoment ToMoment(const v1::Keyframe& keyframe, double fps, const std::string& field);

/// For StreamDance. `fresh_seed` is used where the message has none.
DanceConfig ToDanceConfig(const v1::DanceConfig& config, const ModelInfo& model,
                          uint64_t fresh_seed);

/// For GenerateTransition, but for the samples of encoded files (see EncodedAudio).
GroupRequest ToGroupRequest(const v1::GenerateTransitionRequest& request, const ModelInfo& model,
                            uint64_t fresh_seed);

/// PCM bytes -> samples, interleaved, full scale [-1, 1].
std::vector<float> ToSamples(const std::string& bytes, const v1::AudioFormat& format,
                             const std::string& field);

/// Throws Error(kUnimplemented) naming the first control: no model has any yet.
void CheckControls(const v1::Controls& controls, const ModelInfo& model, const std::string& field);

// ---- out

void FromSkeleton(const Skeleton& skeleton, v1::Skeleton* out);
void FromFrames(int64_t first_frame, std::span<const Pose> poses,
                std::span<const std::array<float, 4>> contacts, v1::RotationEncoding encoding,
                v1::Frames* out);
/// `audio_format` null: no music.
void FromContinuation(const Continuation& continuation, const ModelInfo& model, uint64_t seed,
                      const v1::AudioFormat* audio_format, v1::Continuation* out);
void FromReport(const QualityReport& report, v1::QualityReport* out);
void FromEvent(const DanceEvent& event, double fps, v1::Event* out);
void FromModel(const ModelInfo& model, v1::ModelInfo* out);

}  // namespace choreo
