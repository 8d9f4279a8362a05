#include "model/engine/engine_kind.h"

#include <algorithm>

#include "model/core/error.h"

namespace choreo {

std::string EngineKindNames() {
  std::string names;
  for (const std::string_view name : kEngineKindNames) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  return names;
}

EngineKind ParseEngineKind(std::string_view text, const std::string& field) {
  const auto name = std::ranges::find(kEngineKindNames, text);
  if (name == kEngineKindNames.end()) {
    throw InvalidArgument(field, "\"" + std::string(text) + "\" is none of " + EngineKindNames());
  }
  return static_cast<EngineKind>(name - kEngineKindNames.begin());
}

}  // namespace choreo
