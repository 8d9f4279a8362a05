#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstdint>

/// Converts wire bytes to messages of the API and back.
namespace choreo {

/// The most bytes of one message on the wire.
inline constexpr int64_t kMaxMessageBytes = 16 << 20;
/// The most bytes of one message on the wire, excluding its music.
inline constexpr int64_t kMaxOtherBytes = 4 << 20;
/// The most fields of one message on the wire, including nested ones. An array of numbers counts as
/// one field, a passage as four; kMaxPassages passages fit.
inline constexpr int kMaxFields = 32'768;

inline constexpr int kMaxHistoryPoses = 1'000;
inline constexpr int kMaxAfterPoses = 60;

/// Parses a request. Checks the limits above on the wire format before it allocates anything,
/// because the two bytes of an empty pose would take a hundred bytes of memory. Throws
/// Error(kInvalidArgument) with field, value and limit, and for malformed messages. Thread-safe.
void ReadMessage(const grpc::ByteBuffer& bytes, google::protobuf::Message* message);

/// Serialises an answer. Thread-safe.
grpc::ByteBuffer WriteMessage(const google::protobuf::Message& message);

}  // namespace choreo
