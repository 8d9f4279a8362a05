#include "tests/proto/compatibility.h"

#include <utility>

namespace choreo {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::MethodDescriptor;
using google::protobuf::ServiceDescriptor;

std::string TypeName(const FieldDescriptor& field) {
  if (field.message_type() != nullptr) return field.message_type()->full_name();
  if (field.enum_type() != nullptr) return field.enum_type()->full_name();
  return field.type_name();
}

/// How often a field may occur, and whether its absence is visible.
std::string Label(const FieldDescriptor& field) {
  if (field.is_repeated()) return "repeated";
  return field.has_presence() ? "optional" : "plain";
}

std::string Oneof(const FieldDescriptor& field) {
  const auto* oneof = field.real_containing_oneof();
  return oneof == nullptr ? "no oneof" : oneof->name();
}

std::string Streaming(bool streams) { return streams ? "a stream" : "one message"; }

class Comparison {
 public:
  explicit Comparison(const DescriptorPool& current) : current_(current) {}

  void File(const FileDescriptor& file) {
    for (int i = 0; i < file.message_type_count(); ++i) Message(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) Enum(*file.enum_type(i));
    for (int i = 0; i < file.service_count(); ++i) Service(*file.service(i));
  }

  std::vector<std::string> Take() { return std::move(changes_); }

 private:
  void Message(const Descriptor& released) {
    const Descriptor* now = current_.FindMessageTypeByName(released.full_name());
    if (now == nullptr) return Removed(released.full_name());
    for (int i = 0; i < released.field_count(); ++i) Field(*released.field(i), *now);
    for (int i = 0; i < now->field_count(); ++i) {
      const FieldDescriptor& field = *now->field(i);
      if (released.IsReservedNumber(field.number()) || released.IsReservedName(field.name()))
        changes_.push_back(field.full_name() + ": uses what was reserved");
    }
    for (int i = 0; i < released.nested_type_count(); ++i) Message(*released.nested_type(i));
    for (int i = 0; i < released.enum_type_count(); ++i) Enum(*released.enum_type(i));
  }

  void Field(const FieldDescriptor& released, const Descriptor& message) {
    const FieldDescriptor* now = message.FindFieldByName(released.name());
    if (now == nullptr) return Removed(released.full_name());
    Same(released.full_name(), "number", std::to_string(released.number()),
         std::to_string(now->number()));
    Same(released.full_name(), "type", TypeName(released), TypeName(*now));
    Same(released.full_name(), "label", Label(released), Label(*now));
    Same(released.full_name(), "oneof", Oneof(released), Oneof(*now));
  }

  void Enum(const EnumDescriptor& released) {
    const EnumDescriptor* now = current_.FindEnumTypeByName(released.full_name());
    if (now == nullptr) return Removed(released.full_name());
    for (int i = 0; i < released.value_count(); ++i) {
      const auto& value = *released.value(i);
      // A value's own full name leaves its enum out.
      const std::string name = released.full_name() + '.' + value.name();
      const auto* value_now = now->FindValueByName(value.name());
      if (value_now == nullptr) {
        Removed(name);
      } else {
        Same(name, "number", std::to_string(value.number()), std::to_string(value_now->number()));
      }
    }
  }

  void Service(const ServiceDescriptor& released) {
    const ServiceDescriptor* now = current_.FindServiceByName(released.full_name());
    if (now == nullptr) return Removed(released.full_name());
    for (int i = 0; i < released.method_count(); ++i) {
      const MethodDescriptor& method = *released.method(i);
      const MethodDescriptor* method_now = now->FindMethodByName(method.name());
      if (method_now == nullptr) {
        Removed(method.full_name());
        continue;
      }
      Same(method.full_name(), "request", method.input_type()->full_name(),
           method_now->input_type()->full_name());
      Same(method.full_name(), "response", method.output_type()->full_name(),
           method_now->output_type()->full_name());
      Same(method.full_name(), "request", Streaming(method.client_streaming()),
           Streaming(method_now->client_streaming()));
      Same(method.full_name(), "response", Streaming(method.server_streaming()),
           Streaming(method_now->server_streaming()));
    }
  }

  void Removed(const std::string& name) { changes_.push_back(name + ": removed"); }

  void Same(const std::string& name, const std::string& property, const std::string& released,
            const std::string& now) {
    if (released == now) return;
    changes_.push_back(name + ": " + property + " was " + released + ", is " + now);
  }

  const DescriptorPool& current_;
  std::vector<std::string> changes_;
};

}  // namespace

std::vector<std::string> BreakingChanges(const FileDescriptor& released,
                                         const DescriptorPool& current) {
  Comparison comparison(current);
  comparison.File(released);
  return comparison.Take();
}

}  // namespace choreo
