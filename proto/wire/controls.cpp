#include "proto/wire/controls.h"

#include "model/core/error.h"
#include "model/motion/velocity_factors.h"

namespace choreo::wire {
namespace {

void Write(const ControlRequest::RootPath& path, v1::RootPath* out) {
  out->mutable_frames()->Add(path.frames.begin(), path.frames.end());
  for (const Eigen::Vector2d& point : path.points) {
    for (const double value : point) out->add_points(static_cast<float>(value));
  }
  for (const double height : path.heights) out->add_heights(static_cast<float>(height));
}

void Read(const v1::RootPath& message, const std::string& field, ControlRequest::RootPath* path) {
  if (message.points_size() % 2 != 0) {
    throw InvalidArgument(field + ".points", std::to_string(message.points_size()) +
                                                 " numbers, not two for each point");
  }
  path->frames.assign(message.frames().begin(), message.frames().end());
  for (int i = 0; i < message.points_size(); i += 2)
    path->points.emplace_back(message.points(i), message.points(i + 1));
  path->heights.assign(message.heights().begin(), message.heights().end());
}

void Write(const ControlRequest::VelocityFactors& velocity, v1::VelocityFactors* out) {
  out->mutable_frames()->Add(velocity.frames.begin(), velocity.frames.end());
  for (const double factor : velocity.factors) out->add_factors(static_cast<float>(factor));
  for (const double speed : velocity.speeds) out->add_speeds(static_cast<float>(speed));
  out->set_reference(velocity.reference);
  for (const std::string& name : velocity.parts) {
    const std::optional<BodyPart> part = FindBodyPart(name);
    if (!part) {
      throw InvalidArgument("velocity_factors.parts",
                            '"' + name + "\" is none of " + BodyPartNames());
    }
    out->add_parts(static_cast<v1::BodyPart>(v1::BODY_PART_TRUNK + static_cast<int>(*part)));
  }
}

void Read(const v1::VelocityFactors& message, const std::string& field,
          ControlRequest::VelocityFactors* velocity) {
  velocity->frames.assign(message.frames().begin(), message.frames().end());
  velocity->factors.assign(message.factors().begin(), message.factors().end());
  velocity->speeds.assign(message.speeds().begin(), message.speeds().end());
  velocity->reference = message.reference();
  for (const int number : message.parts()) {
    const int part = number - v1::BODY_PART_TRUNK;
    if (part < 0 || part >= kBodyParts) {
      throw InvalidArgument(field + ".parts[" + std::to_string(velocity->parts.size()) + "]",
                            std::to_string(number) + " is no BodyPart");
    }
    velocity->parts.emplace_back(kBodyPartNames[static_cast<size_t>(part)]);
  }
}

}  // namespace

v1::Controls ToProto(const ControlRequest& controls) {
  v1::Controls out;
  if (controls.root_path) Write(*controls.root_path, out.mutable_root_path());
  if (controls.velocity_factors) Write(*controls.velocity_factors, out.mutable_velocity_factors());
  return out;
}

ControlRequest FromProto(const v1::Controls& controls, const std::string& field) {
  ControlRequest out;
  if (controls.has_root_path())
    Read(controls.root_path(), field + ".root_path",
         &out.root_path.emplace(ControlRequest::RootPath()));
  if (controls.has_velocity_factors()) {
    Read(controls.velocity_factors(), field + ".velocity_factors",
         &out.velocity_factors.emplace(ControlRequest::VelocityFactors()));
  }
  return out;
}

}  // namespace choreo::wire
