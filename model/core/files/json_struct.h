#pragma once

#include <nlohmann/json.hpp>

#define CHOREO_TO_JSON(Type, ...)                                              \
  void to_json(nlohmann::json& nlohmann_json_j, const Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))   \
  }

/// Defines to_json and from_json of a struct; its header declares them. One list of fields serves
/// both, so that every field written is also read. All fields are required.
#define CHOREO_JSON_FIELDS(Type, ...)                                            \
  CHOREO_TO_JSON(Type, __VA_ARGS__)                                              \
  void from_json(const nlohmann::json& nlohmann_json_j, Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__))   \
  }

/// Like CHOREO_JSON_FIELDS, for options: missing fields keep their defaults.
#define CHOREO_JSON_OPTIONS(Type, ...)                                                      \
  CHOREO_TO_JSON(Type, __VA_ARGS__)                                                         \
  void from_json(const nlohmann::json& nlohmann_json_j, Type& nlohmann_json_t) {            \
    const Type nlohmann_json_default_obj{};                                                 \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM_WITH_DEFAULT, __VA_ARGS__)) \
  }
