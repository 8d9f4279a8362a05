#include "model/plan/plan_options.h"

#include "model/core/error.h"
#include "model/core/files/json_struct.h"

namespace choreo {

void PlanOptions::Check(const std::string& field) const {
  if (accent < 0 || accent >= 1) throw InvalidArgument(field + ".accent", "is not a share below 1");
  if (whole_accent <= 0) throw InvalidArgument(field + ".whole_accent", "is not above 0");
  if (fastest <= 0) throw InvalidArgument(field + ".fastest", "is not above 0");
  if (hinge_softness <= 0) throw InvalidArgument(field + ".hinge_softness", "is not above 0");
  footwork.Check(field + ".footwork");
}

CHOREO_JSON_OPTIONS(PlanOptions, accent, whole_accent, fastest, hinge_softness, footwork)

}  // namespace choreo
