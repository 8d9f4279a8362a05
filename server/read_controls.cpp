#include "server/read_controls.h"

#include "model/core/error.h"
#include "model/dance/validation.h"

namespace choreo {
namespace {

RootPath ToRootPath(const v1::RootPath& message, const std::string& field) {
  if (message.points_size() % 2 != 0) {
    throw InvalidArgument(field + ".points", std::to_string(message.points_size()) +
                                                 " numbers, not two for each point");
  }
  const int count = message.points_size() / 2;
  if (message.heights_size() != 0 && message.heights_size() != count) {
    throw InvalidArgument(field + ".heights", std::to_string(message.heights_size()) +
                                                  " heights for " + std::to_string(count) +
                                                  " points");
  }
  RootPath path;
  path.frames.assign(message.frames().begin(), message.frames().end());
  path.points.setZero(3, count);
  path.has_heights = message.heights_size() != 0;
  for (int i = 0; i < count; ++i) {
    path.points(0, i) = message.points(2 * i);
    path.points(2, i) = message.points(2 * i + 1);
    if (path.has_heights) path.points(1, i) = message.heights(i);
  }
  return path;
}

VelocityRequest ToVelocity(const v1::VelocityFactors& message, const std::string& field) {
  VelocityRequest velocity;
  velocity.frames.assign(message.frames().begin(), message.frames().end());
  for (int i = 0; i < message.parts_size(); ++i) {
    const int part = message.parts(i) - v1::BODY_PART_TRUNK;
    if (part < 0 || part >= kBodyParts) {
      throw InvalidArgument(At(field + ".parts", i),
                            std::to_string(message.parts(i)) + " is no BodyPart");
    }
    velocity.parts.push_back(static_cast<BodyPart>(part));
  }
  if (message.factors_size() > 0 && message.speeds_size() > 0) {
    throw InvalidArgument(field + ".speeds", "and factors exclude each other");
  }
  velocity.absolute = message.speeds_size() > 0;
  const auto& values = velocity.absolute ? message.speeds() : message.factors();
  velocity.values.assign(values.begin(), values.end());
  velocity.reference = message.reference();
  return velocity;
}

}  // namespace

ControlRequest ToControls(const v1::Controls& controls, const std::string& field) {
  ControlRequest request;
  if (controls.has_root_path()) {
    request.root_path = ToRootPath(controls.root_path(), field + ".root_path");
  }
  if (controls.has_velocity_factors()) {
    request.velocity_factors = ToVelocity(controls.velocity_factors(), field + ".velocity_factors");
  }
  if (!request.root_path && !request.velocity_factors) {
    throw InvalidArgument(field, "empty; root_path or velocity_factors must be there");
  }
  return request;
}

}  // namespace choreo
