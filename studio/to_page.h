#pragma once

#include "client/choreo_client.h"
#include "client/edit.h"
#include "studio/studio.pb.h"

/// The client library's structs as messages of choreo.v1 for the page.
namespace choreo::studio {

v1::StreamDanceResponse ToProto(const client::Header& header);
v1::StreamDanceResponse ToProto(const client::FrameBlock& block);
/// `fps`: the model's.
v1::StreamDanceResponse ToProto(const DanceEvent& event, double fps);
v1::StreamDanceResponse ToProto(const client::Report& report);
Clip ToProto(const client::FinishedDance& dance);

}  // namespace choreo::studio
