#include "model/dance/velocity_request.h"

#include <algorithm>
#include <span>

#include "model/core/error.h"
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

}  // namespace

void VelocityRequest::Validate(const ModelInfo& model, const std::string& field) const {
  ValidateFrames(frames, field + ".frames");
  for (size_t i = 0; i < parts.size(); ++i) {
    if (std::ranges::count(std::span(parts).first(i), parts[i]) == 0) continue;
    throw InvalidArgument(
        field + ".parts[" + std::to_string(i) + "]",
        std::string(kBodyPartNames[static_cast<size_t>(parts[i])]) + " is there twice");
  }
  const std::string name = field + (absolute ? ".speeds" : ".factors");
  const size_t rows = std::max<size_t>(1, frames.size());
  if (values.size() != rows * Columns(*this)) {
    throw InvalidArgument(name, std::to_string(values.size()) +
                                    " values, but rows times columns are " + std::to_string(rows) +
                                    " times " + std::to_string(Columns(*this)));
  }
  const float limit = absolute ? kMaxVelocity : kMaxVelocityFactor;
  for (size_t i = 0; i < values.size(); ++i) {
    // Written so that NaN fails too.
    if (values[i] >= 0 && values[i] <= limit) continue;
    throw InvalidArgument(
        name + "[" + std::to_string(i) + "]",
        Show(values[i]) + (absolute ? " m a frame" : "") + " is not in [0, " + Show(limit) + "]");
  }
  if (absolute && !reference.empty())
    throw InvalidArgument(field + ".reference",
                          '"' + reference + "\" stands beside speeds, which have none");
  if (!absolute && FindReference(model, reference) == nullptr) {
    std::string known;
    for (const VelocityReference& one : model.velocity_references) {
      known += (known.empty() ? "" : ", ") + one.name;
    }
    throw InvalidArgument(field + ".reference", '"' + reference + "\" is none of the model's, " +
                                                    (known.empty() ? "which has none" : known));
  }
}

bool VelocityRequest::Names(BodyPart part) const {
  return parts.empty() || std::ranges::find(parts, part) != parts.end();
}

float VelocityRequest::At(int64_t frame, BodyPart part, const ModelInfo& model) const {
  const auto column =
      parts.empty() ? 0 : static_cast<size_t>(std::ranges::find(parts, part) - parts.begin());
  const auto value = [&](size_t row) { return values[row * Columns(*this) + column]; };
  const auto after = static_cast<size_t>(std::ranges::upper_bound(frames, frame) - frames.begin());
  float asked = value(after == 0 ? 0 : after - 1);
  if (after > 0 && after < frames.size()) {
    const auto share = static_cast<float>(frame - frames[after - 1]) /
                       static_cast<float>(frames[after] - frames[after - 1]);
    asked += share * (value(after) - asked);
  }
  if (absolute) return asked;
  return asked * FindReference(model, reference)->factors[static_cast<size_t>(part)];
}

}  // namespace choreo
