#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstdint>

/// Wire bytes <-> messages of the API.
namespace choreo {

/// The most bytes of one message on the wire.
inline constexpr int64_t kMaxMessageBytes = 16 << 20;
/// The most bytes of one message on the wire, without its music.
inline constexpr int64_t kMaxOtherBytes = 4 << 20;
/// The most fields of one message on the wire, nested ones included; an array of numbers is one. A
/// passage has four, and kMaxPassages of them fit.
inline constexpr int kMaxFields = 32'768;

inline constexpr int kMaxHistoryPoses = 1'000;
inline constexpr int kMaxAfterPoses = 60;

/// Reads a request. Two bytes of an empty pose would become a hundred bytes of memory, so these
/// limits are checked on the wire format, before anything is allocated. Throws
/// Error(kInvalidArgument) with field, value and limit, and for malformed messages. Thread-safe.
void ReadMessage(const grpc::ByteBuffer& bytes, google::protobuf::Message* message);

/// Writes an answer. Thread-safe.
grpc::ByteBuffer WriteMessage(const google::protobuf::Message& message);

}  // namespace choreo
