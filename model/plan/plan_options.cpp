#include "model/plan/plan_options.h"

#include "model/core/error.h"
#include "model/core/json_fields.h"

namespace choreo {

void PlanOptions::Validate(const std::string& field) const {
  if (accent < 0 || key_accent < 0 || accent + key_accent > 1)
    throw InvalidArgument(field + ".accent", "the accents are not two shares of at most 1 in all");
  if (whole_accent <= 0) throw InvalidArgument(field + ".whole_accent", "is not above 0");
  if (fastest <= 0) throw InvalidArgument(field + ".fastest", "is not above 0");
  if (on_beat < 0) throw InvalidArgument(field + ".on_beat", "is below 0");
  if (no_key_accent < 0) throw InvalidArgument(field + ".no_key_accent", "is below 0");
  if (whole_key_accent <= no_key_accent)
    throw InvalidArgument(field + ".whole_key_accent", "is not above no_key_accent");
  if (hinge_softness <= 0) throw InvalidArgument(field + ".hinge_softness", "is not above 0");
  footwork.Validate(field + ".footwork");
}

CHOREO_JSON_OPTIONS(PlanOptions, accent, key_accent, whole_accent, fastest, on_beat, no_key_accent,
                    whole_key_accent, hinge_softness, footwork)

}  // namespace choreo
