#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace choreo {

/// Joins the elements into one text for messages: "calm, wild". `text` converts an element to text.
template <typename Range, typename Text = std::identity>
std::string Joined(const Range& range, const Text& text = {}, std::string_view separator = ", ") {
  std::string all;
  for (const auto& one : range) {
    if (!all.empty()) all += separator;
    all += std::invoke(text, one);
  }
  return all;
}

}  // namespace choreo
