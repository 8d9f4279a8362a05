#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstdint>

/// Bytes of the wire <-> messages of the API.
namespace choreo {

/// Of one message on the wire, in all.
inline constexpr int64_t kMaxMessageBytes = 16 << 20;
/// Of one message on the wire, all but its music.
inline constexpr int64_t kMaxOtherBytes = 4 << 20;
/// Fields of one message on the wire, those of the messages in it counted as well; an array of
/// numbers is one.
inline constexpr int kMaxFields = 16'384;

inline constexpr int kMaxHistoryPoses = 1'000;
inline constexpr int kMaxAfterPoses = 60;

/// Reads a request. Two bytes of an empty pose would become a hundred bytes of memory, so what goes
/// beyond these limits is refused as it stands on the wire, before anything is allocated for it.
/// Throws Error(kInvalidArgument) with field, value and limit, and for what is no such message.
/// Thread-safe.
void ReadMessage(const grpc::ByteBuffer& bytes, google::protobuf::Message* message);

/// Writes an answer. Thread-safe.
grpc::ByteBuffer WriteMessage(const google::protobuf::Message& message);

}  // namespace choreo
