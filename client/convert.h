#pragma once

#include <span>

#include "choreo/v1/choreography.pb.h"
#include "client/choreo_client.h"
#include "proto/wire/convert.h"

/// Converts between the public structs and the messages of choreo.v1. Checks received messages:
/// throws Error(kInternal) if a server breaks the protocol.
namespace choreo::client {

using wire::FromProto, wire::ToProto;

v1::DanceConfig ToProto(const DanceConfig& config);
v1::Keyframe ToProto(const KeyPose& key);

/// Returns the samples as the bytes of little-endian floats.
std::string ToPcmBytes(std::span<const float> samples);

/// Checks the lengths of the arrays. `joints`: the number of joints in the header's skeleton.
void CheckFrames(const v1::Frames& frames, int joints);
FrameBlock FromProto(const v1::Frames& frames, int joints);
Continuation FromProto(const v1::Continuation& continuation);
Report FromProto(const v1::QualityReport& report, const v1::Timing& timing);
ServerDescription FromProto(const v1::GetServerInfoResponse& response);

}  // namespace choreo::client
