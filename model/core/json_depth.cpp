#include "model/core/json_depth.h"

#include "model/core/error.h"

namespace choreo {

void CheckJsonDepth(std::string_view json, const std::string& name) {
  constexpr int kLimit = 64;
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') {
      in_text = !in_text;
    } else if (in_text) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > kLimit) {
        throw InvalidArgument(name, "is JSON of more than " + std::to_string(kLimit) +
                                        " levels, from character " + std::to_string(i));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace choreo
