#include "model/dance/velocity_request.h"

#include <algorithm>
#include <span>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/dance/validation.h"

namespace choreo {
namespace {

const VelocityReference* FindReference(const ModelInfo& model, const std::string& name) {
  const auto& references = model.velocity_references;
  const auto found = name.empty() ? references.begin()
                                  : std::ranges::find(references, name, &VelocityReference::name);
  return found == references.end() ? nullptr : &*found;
}

size_t Columns(const VelocityRequest& request) { return std::max<size_t>(1, request.parts.size()); }

bool IsAbsolute(const VelocityRequest& request) { return !request.speeds.empty(); }

const std::vector<double>& ValuesOf(const VelocityRequest& request) {
  return IsAbsolute(request) ? request.speeds : request.factors;
}

void ValidateParts(const std::vector<std::string>& parts, const std::string& field) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::string at = field + "[" + std::to_string(i) + "]";
    if (!FindBodyPart(parts[i]))
      throw InvalidArgument(at, '"' + parts[i] + "\" is none of " + BodyPartNames());
    if (std::ranges::count(std::span(parts).first(i), parts[i]) > 0)
      throw InvalidArgument(at, parts[i] + " is there twice");
  }
}

}  // namespace

void ValidateVelocities(const VelocityRequest& request, const ModelInfo& model,
                        const std::string& field) {
  ValidateFrames(request.frames, field + ".frames");
  ValidateParts(request.parts, field + ".parts");
  const bool absolute = IsAbsolute(request);
  if (absolute && !request.factors.empty())
    throw InvalidArgument(field + ".speeds", "and factors exclude each other");
  const std::string name = field + (absolute ? ".speeds" : ".factors");
  const size_t rows = std::max<size_t>(1, request.frames.size()), columns = Columns(request);
  const std::vector<double>& values = ValuesOf(request);
  if (values.size() != rows * columns) {
    throw InvalidArgument(name, std::to_string(values.size()) +
                                    " values, but rows times columns are " + std::to_string(rows) +
                                    " times " + std::to_string(columns));
  }
  const double limit = absolute ? kMaxVelocity : kMaxVelocityFactor;
  for (size_t i = 0; i < values.size(); ++i) {
    // Written so that NaN fails too.
    if (values[i] >= 0 && values[i] <= limit) continue;
    throw InvalidArgument(
        name + "[" + std::to_string(i) + "]",
        Show(values[i]) + (absolute ? " m a frame" : "") + " is not in [0, " + Show(limit) + "]");
  }
  const std::string& reference = request.reference;
  if (absolute && !reference.empty())
    throw InvalidArgument(field + ".reference",
                          '"' + reference + "\" stands beside speeds, which have none");
  if (!absolute && FindReference(model, reference) == nullptr) {
    const std::string known = Joined(model.velocity_references, &VelocityReference::name);
    throw InvalidArgument(field + ".reference", '"' + reference + "\" is none of the model's, " +
                                                    (known.empty() ? "which has none" : known));
  }
}

bool Names(const VelocityRequest& request, BodyPart part) {
  const std::string_view name = kBodyPartNames[static_cast<size_t>(part)];
  return request.parts.empty() || std::ranges::find(request.parts, name) != request.parts.end();
}

float SpeedAt(const VelocityRequest& request, int64_t frame, BodyPart part,
              const ModelInfo& model) {
  const auto& [frames, parts, factors, speeds, reference] = request;
  const std::string_view name = kBodyPartNames[static_cast<size_t>(part)];
  const auto column =
      parts.empty() ? 0 : static_cast<size_t>(std::ranges::find(parts, name) - parts.begin());
  const std::vector<double>& values = ValuesOf(request);
  const auto value = [&](size_t row) {
    return static_cast<float>(values[row * Columns(request) + column]);
  };
  const auto after = static_cast<size_t>(std::ranges::upper_bound(frames, frame) - frames.begin());
  float asked = value(after == 0 ? 0 : after - 1);
  if (after > 0 && after < frames.size()) {
    const auto share = static_cast<float>(frame - frames[after - 1]) /
                       static_cast<float>(frames[after] - frames[after - 1]);
    asked += share * (value(after) - asked);
  }
  if (IsAbsolute(request)) return asked;
  return asked * FindReference(model, reference)->speeds[static_cast<size_t>(part)];
}

}  // namespace choreo
