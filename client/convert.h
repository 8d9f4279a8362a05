#pragma once

#include <span>

#include "choreo/v1/choreography.pb.h"
#include "client/choreo_client.h"

/// Between the public structs and the messages of choreo.v1, both ways. What comes in is checked: a
/// server that breaks the protocol raises Error(kInternal).
namespace choreo::client {

v1::DanceConfig ToProto(const DanceConfig& config);
v1::MusicPassage ToProto(const Passage& passage);
v1::Keyframe ToProto(const KeyPose& key);
v1::Controls ToProto(const Controls& controls);
v1::Pose ToProto(const Pose& pose);
v1::JointMask ToProto(const PoseMask& mask);

/// A pose without a root position where the mask does not ask for one.
v1::Pose ToProto(const Pose& pose, const PoseMask& mask);

/// Bytes of little-endian floats.
std::string ToPcmBytes(std::span<const float> samples);

Skeleton FromProto(const v1::Skeleton& skeleton);
Header FromProto(const v1::Header& header);
/// `joints`: of the header's skeleton.
FrameBlock FromProto(const v1::Frames& frames, int joints);
Continuation FromProto(const v1::Continuation& continuation);
Report FromProto(const v1::QualityReport& report, const v1::Timing& timing);
ServerDescription FromProto(const v1::GetServerInfoResponse& response);
/// None for a kind of event that this client does not know yet.
std::optional<Message> FromProto(const v1::Event& event);

}  // namespace choreo::client
