#pragma once

#include <google/protobuf/message.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"
#include "model/core/passage.h"
#include "model/motion/controls/control_request.h"
#include "model/motion/controls/controls.h"

/// Converts controls to the API's messages and back, for server, client and studio. Pure functions,
/// thread-safe.
namespace choreo::wire {

/// Throws Error(kInvalidArgument) for an unknown body part.
v1::Controls ToProto(const ControlRequest& controls);

/// Throws Error(kInvalidArgument) below `field` for malformed controls: incomplete points or
/// unknown body parts. The engine validates the values.
ControlRequest FromProto(const v1::Controls& controls, const std::string& field);

/// A visitor for VisitFields, VisitSettings or VisitFacts: writes each value into the message's
/// field of that name. `field`: the control's path in errors.
class FieldWriter {
 public:
  FieldWriter(google::protobuf::Message* out, std::string field)
      : out_(out), field_(std::move(field)) {}

  void operator()(const char* name, const std::vector<int64_t>& frames) const;
  void operator()(const char* name, const std::vector<double>& values) const;
  void operator()(const char* name, const std::vector<float>& values) const;
  void operator()(const char* name, const std::vector<Eigen::Vector2d>& points) const;
  void operator()(const char* name, const std::vector<std::string>& parts) const;
  void operator()(const char* name, const std::vector<Passage>& passages) const;
  void operator()(const char* name, const std::string& text) const;
  void operator()(const char* name, const std::optional<double>& number) const;
  void operator()(const char* name, uint64_t number) const;

 private:
  google::protobuf::Message* out_;
  std::string field_;
};

/// A visitor that reads what FieldWriter writes.
class FieldReader {
 public:
  /// The message must outlive this object.
  FieldReader(const google::protobuf::Message& message, std::string field)
      : message_(message), field_(std::move(field)) {}

  void operator()(const char* name, std::vector<int64_t>& frames) const;
  void operator()(const char* name, std::vector<double>& values) const;
  void operator()(const char* name, std::vector<float>& values) const;
  void operator()(const char* name, std::vector<Eigen::Vector2d>& points) const;
  void operator()(const char* name, std::vector<std::string>& parts) const;
  void operator()(const char* name, std::vector<Passage>& passages) const;
  void operator()(const char* name, std::string& text) const;
  /// None if the field was not sent, or the message has no such field.
  void operator()(const char* name, std::optional<double>& number) const;
  void operator()(const char* name, uint64_t& number) const;

 private:
  const google::protobuf::Message& message_;
  std::string field_;
};

/// The message's field with this name. Throws Error(kInternal) if there is none.
const google::protobuf::FieldDescriptor* FieldOf(const google::protobuf::Message& message,
                                                 std::string_view name);

/// Writes a control request into a message that has a field for each row.
template <typename Request>
void WriteControls(const Request& request, google::protobuf::Message* out,
                   std::span<const ControlRow> rows = kControls) {
  Request::VisitControls(
      [&](size_t row, const auto& control) {
        if (!control) return;
        const std::string name(rows[row].name);
        control->VisitFields(
            *control,
            FieldWriter(out->GetReflection()->MutableMessage(out, FieldOf(*out, name)), name));
      },
      request);
}

/// Reads a control request from its message. Errors are below `field`.
template <typename Request>
void ReadControls(const google::protobuf::Message& message, const std::string& field,
                  Request* request, std::span<const ControlRow> rows = kControls) {
  Request::VisitControls(
      [&](size_t row, auto& control) {
        const std::string name(rows[row].name);
        const auto* sent = FieldOf(message, name);
        if (!message.GetReflection()->HasField(message, sent)) return;
        control.emplace();
        control->VisitFields(
            *control,
            FieldReader(message.GetReflection()->GetMessage(message, sent), field + '.' + name));
      },
      *request);
}

}  // namespace choreo::wire
