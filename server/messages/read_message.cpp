#include "server/messages/read_message.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <string>

#include "choreo/v1/choreography.pb.h"
#include "model/core/error.h"

namespace choreo {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::CodedInputStream;

Error Malformed(const Descriptor& type) {
  return InvalidArgument("request", "the bytes are not a " + type.full_name());
}

/// Counts the elements of a serialised message without parsing it into memory.
class WireCheck {
 public:
  explicit WireCheck(CodedInputStream& in) : in_(in) {}

  void Check(const Descriptor& type) {
    Fields(type, "");
    CheckPoses(kHistory, history_poses_, kMaxHistoryPoses);
    CheckPoses(kAfter, after_poses_, kMaxAfterPoses);
    const int64_t others = in_.CurrentPosition() - music_bytes_;
    if (others > kMaxOtherBytes) {
      throw InvalidArgument("request", std::to_string(others) +
                                           " bytes beside the music, at most " +
                                           std::to_string(kMaxOtherBytes));
    }
  }

 private:
  static constexpr const char* kHistory = "config.history.poses";
  static constexpr const char* kAfter = "after";
  enum WireType { kVarint = 0, kFixed64 = 1, kLength = 2, kFixed32 = 5 };

  static void CheckPoses(const char* name, int poses, int most) {
    if (poses <= most) return;
    throw InvalidArgument(name,
                          std::to_string(poses) + " poses, more than " + std::to_string(most));
  }

  void Fields(const Descriptor& type, const std::string& path) {
    while (const uint32_t tag = in_.ReadTag()) {
      const FieldDescriptor* field = type.FindFieldByNumber(static_cast<int>(tag >> 3));
      const std::string name = path + (field ? field->name() : "unknown field");
      if (++fields_ > kMaxFields) {
        throw InvalidArgument(name, "more than " + std::to_string(kMaxFields) +
                                        " fields in one message; numbers go in packed arrays");
      }
      if (!Field(tag & 7, field, name)) throw Malformed(type);
    }
    if (!in_.ConsumedEntireMessage()) throw Malformed(type);
  }

  // False for malformed bytes, including groups, which no version of the API has.
  bool Field(uint32_t wire_type, const FieldDescriptor* field, const std::string& name) {
    uint64_t number = 0;
    uint32_t word = 0;
    switch (wire_type) {
      case kVarint:
        return in_.ReadVarint64(&number);
      case kFixed64:
        return in_.ReadLittleEndian64(&number);
      case kFixed32:
        return in_.ReadLittleEndian32(&word);
      case kLength:
        break;
      default:
        return false;
    }
    if (!in_.ReadVarint32(&word) || word > static_cast<uint32_t>(kMaxMessageBytes)) return false;
    const int size = static_cast<int>(word);
    if (field == nullptr || field->message_type() == nullptr) {
      if (field != nullptr && field->containing_type() == v1::Audio::descriptor()) {
        music_bytes_ += size;
      }
      return in_.Skip(size);
    }
    if (name == kHistory) ++history_poses_;
    if (name == kAfter) ++after_poses_;
    const CodedInputStream::Limit outer = in_.PushLimit(size);
    Fields(*field->message_type(), name + '.');
    in_.PopLimit(outer);
    return true;
  }

  CodedInputStream& in_;
  int fields_ = 0;
  int history_poses_ = 0;
  int after_poses_ = 0;
  int64_t music_bytes_ = 0;
};

}  // namespace

void ReadMessage(const grpc::ByteBuffer& bytes, google::protobuf::Message* message) {
  grpc::ByteBuffer shared(bytes);  // shares the bytes; a reader needs a mutable buffer
  grpc::ProtoBufferReader first(&shared);
  {
    CodedInputStream in(&first);
    WireCheck(in).Check(*message->GetDescriptor());
  }
  grpc::ProtoBufferReader second(&shared);
  if (!message->ParseFromZeroCopyStream(&second)) throw Malformed(*message->GetDescriptor());
}

grpc::ByteBuffer WriteMessage(const google::protobuf::Message& message) {
  grpc::ByteBuffer bytes;
  bool own = false;
  grpc::SerializationTraits<google::protobuf::Message>::Serialize(message, &bytes, &own);
  return bytes;
}

}  // namespace choreo
