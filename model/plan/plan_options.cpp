#include "model/plan/plan_options.h"

#include "model/core/error.h"
#include "model/core/files/json_struct.h"

namespace choreo {

void WristOptions::Check(const std::string& field) const {
  const std::pair<const char*, double> options[] = {
      {"twist", twist}, {"deviation", deviation}, {"flexion", flexion}, {"memory", memory}};
  for (const auto& [name, value] : options) {
    if (!(value > 0)) throw InvalidArgument(field + "." + name, "is not above 0");
  }
}

CHOREO_JSON_OPTIONS(WristOptions, twist, deviation, flexion, memory)

void PlanOptions::Check(const std::string& field) const {
  if (accent < 0 || accent >= 1) throw InvalidArgument(field + ".accent", "is not a share below 1");
  if (whole_accent <= 0) throw InvalidArgument(field + ".whole_accent", "is not above 0");
  if (fastest <= 0) throw InvalidArgument(field + ".fastest", "is not above 0");
  if (hinge_softness <= 0) throw InvalidArgument(field + ".hinge_softness", "is not above 0");
  footwork.Check(field + ".footwork");
  wrists.Check(field + ".wrists");
}

CHOREO_JSON_OPTIONS(PlanOptions, accent, whole_accent, fastest, hinge_softness, footwork, wrists)

}  // namespace choreo
