#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace choreo {

bool IsFilm(const std::filesystem::path& path);
bool IsPicture(const std::filesystem::path& path);

/// The page of a study, which needs no server: clip by clip it shows the films side by side, plays
/// them together, takes a rank for each and at the end saves a file of answers. `shown`: {"study":
/// number, "clips": [[film, ...], ...]}.
std::string StudyPage(const std::string& question, const nlohmann::ordered_json& shown);

}  // namespace choreo
