#pragma once

#include <vector>

#include "client/choreo_client.h"
#include "client/edit.h"
#include "studio/studio.pb.h"

/// What the page is told: the client library's structs as messages of choreo.v1.
namespace choreo::studio {

v1::Skeleton ToProto(const Skeleton& skeleton);
v1::ModelInfo ToProto(const client::ModelDescription& model);
v1::StreamDanceResponse ToProto(const client::Header& header);
v1::StreamDanceResponse ToProto(const client::FrameBlock& block);
v1::StreamDanceResponse ToProto(const client::KeyReached& reached);
v1::StreamDanceResponse ToProto(const client::KeyRejected& rejected);
v1::StreamDanceResponse ToProto(const client::Beat& beat);
v1::StreamDanceResponse ToProto(const client::Warning& warning);
v1::StreamDanceResponse ToProto(const client::Continuation& continuation);
v1::StreamDanceResponse ToProto(const client::Report& report);
/// Header, frames and warnings, summary.
std::vector<v1::GenerateTransitionResponse> ToProto(const client::TransitionResult& result);
Clip ToProto(const client::FinishedDance& dance);

}  // namespace choreo::studio
