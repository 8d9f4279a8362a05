#include "model/plan/footwork_options.h"

#include <string_view>
#include <utility>

#include "model/core/error.h"
#include "model/core/files/json_struct.h"

namespace choreo {

void FootworkOptions::Check(const std::string& field) const {
  const std::pair<std::string_view, double> all[] = {{"step_cost", step_cost},
                                                     {"flight_cost", flight_cost},
                                                     {"shortest_step", shortest_step},
                                                     {"longest_flight", longest_flight},
                                                     {"acceleration", acceleration},
                                                     {"offset", offset},
                                                     {"reach", reach},
                                                     {"balance", balance},
                                                     {"sole", sole}};
  for (const auto& [name, value] : all) {
    if (!(value > 0)) throw InvalidArgument(field + "." + std::string(name), "is not above 0");
  }
}

CHOREO_JSON_OPTIONS(FootworkOptions, step_cost, flight_cost, shortest_step, longest_flight,
                    acceleration, offset, reach, balance, sole)

}  // namespace choreo
