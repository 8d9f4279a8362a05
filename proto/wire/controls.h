#pragma once

#include <google/protobuf/message.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"
#include "model/motion/control_request.h"

/// Controls <-> the API's, for server, client and studio. Pure functions, thread-safe.
namespace choreo::wire {

/// Throws Error(kInvalidArgument) for a part of the body that there is not.
v1::Controls ToProto(const ControlRequest& controls);

/// Throws Error(kInvalidArgument) below `field` for malformed controls: incomplete points, unknown
/// parts of the body. The engine validates the values.
ControlRequest FromProto(const v1::Controls& controls, const std::string& field);

/// Writes a control's fields (VisitFields) into those of the same names of its message. `field`:
/// the control's path in errors.
class ControlWriter {
 public:
  ControlWriter(google::protobuf::Message* out, std::string field)
      : out_(out), field_(std::move(field)) {}

  void operator()(const char* name, const std::vector<int64_t>& frames) const;
  void operator()(const char* name, const std::vector<double>& values) const;
  void operator()(const char* name, const std::vector<Eigen::Vector2d>& points) const;
  void operator()(const char* name, const std::vector<std::string>& parts) const;
  void operator()(const char* name, const std::string& text) const;

 private:
  google::protobuf::Message* out_;
  std::string field_;
};

/// Reads them back.
class ControlReader {
 public:
  /// The message must outlive it.
  ControlReader(const google::protobuf::Message& message, std::string field)
      : message_(message), field_(std::move(field)) {}

  void operator()(const char* name, std::vector<int64_t>& frames) const;
  void operator()(const char* name, std::vector<double>& values) const;
  void operator()(const char* name, std::vector<Eigen::Vector2d>& points) const;
  void operator()(const char* name, std::vector<std::string>& parts) const;
  void operator()(const char* name, std::string& text) const;

 private:
  const google::protobuf::Message& message_;
  std::string field_;
};

}  // namespace choreo::wire
