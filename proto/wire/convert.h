#pragma once

#include <optional>
#include <vector>

#include "choreo/v1/choreography.pb.h"
#include "choreo/v1/motion.pb.h"
#include "model/core/error.h"
#include "model/core/hand_pose.h"
#include "model/core/passage.h"
#include "model/messages/call_timing.h"
#include "model/messages/dance_event.h"
#include "model/messages/dance_header.h"
#include "model/messages/dance_manner.h"
#include "model/messages/model_description.h"
#include "model/messages/quality_report.h"
#include "model/motion/skeleton.h"
#include "proto/wire/poses.h"

/// Converts our types to messages of the API and back, for server, client and studio. FromProto
/// reads a server's messages, and throws Error(kInternal) for one that breaks the protocol. Pure
/// functions, thread-safe.
namespace choreo::wire {

v1::Skeleton ToProto(const Skeleton& skeleton);
v1::MusicPassage ToProto(const Passage& passage);
v1::HandPose ToProto(HandPose hands);
/// Sets the message's fields named after the manner's settings. The message must have a field for
/// each setting that the manner states.
void Write(const DanceManner& manner, google::protobuf::Message* out);
void Write(const KnownMusic& music, v1::DanceConfig* out);
v1::ModelInfo ToProto(const ModelDescription& model);
/// Writes the header, which declares frames in axis-angle.
v1::Header ToProto(const DanceHeader& header);
v1::QualityReport ToProto(const QualityReport& report);
v1::Timing ToProto(const CallTiming& timing);
/// `fps`: the model's frame rate, at which frames are counted.
v1::Event ToProto(const DanceEvent& event, double fps);

/// Reads a client's message, without checks. Settings that the message lacks are not stated.
DanceManner MannerOf(const google::protobuf::Message& message);
KnownMusic MusicOf(const v1::DanceConfig& config);
Passage FromProto(const v1::MusicPassage& passage);

Skeleton FromProto(const v1::Skeleton& skeleton);
/// None if unspecified or unknown to this version.
std::optional<HandPose> FromProto(v1::HandPose hands);
ModelDescription FromProto(const v1::ModelInfo& model);
DanceHeader FromProto(const v1::Header& header);
QualityReport FromProto(const v1::QualityReport& report);
CallTiming FromProto(const v1::Timing& timing);
/// None if this version does not know the kind of event.
std::optional<DanceEvent> FromProto(const v1::Event& event);

/// The error for a server that breaks the protocol.
Error Broken(const std::string& what);

}  // namespace choreo::wire
