#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace choreo {

bool IsFilm(const std::filesystem::path& path);
bool IsPicture(const std::filesystem::path& path);

/// Writes the HTML page of a study, which needs no server. Clip by clip, the page shows the films
/// side by side, plays them together and asks for a rank of each. At the end it saves a file of
/// answers. `shown`: {"study": number, "clips": [[film, ...], ...]}.
std::string StudyPage(const std::string& question, const nlohmann::ordered_json& shown);

}  // namespace choreo
