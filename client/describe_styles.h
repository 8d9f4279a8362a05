#pragma once

#include <optional>
#include <string>

#include "model/messages/style_figures.h"

namespace choreo::client {

/// Describes, for people, whether a model's styles can be seen in its dances: "They do not show: in
/// 7 % of seconds a classifier recognises the style asked for, by chance in 6 %."
std::string DescribeStyles(const std::optional<StyleFigures>& figures);

}  // namespace choreo::client
