#pragma once

#include "studio/studio_context.h"

namespace choreo::studio {

/// Several dancers on one stage, as `choreo dance --dancers` places them, for the page and in
/// files. Throws Error(kInvalidArgument) that names the dancers' member or the message's field.
Response FormCompany(const StudioContext& context, const Company& request);

}  // namespace choreo::studio
