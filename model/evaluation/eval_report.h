#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// STEM_NAME.png beside the JSON file, NAME without characters that a file's name should not have.
std::filesystem::path PictureBeside(const std::filesystem::path& json, std::string name);

/// Makes missing folders, and throws Error(kInvalidArgument, "--json") with the path where a file
/// could not be written: before the long work, not after.
void CheckReportPath(const std::filesystem::path& json);

/// Writes the JSON file, which begins with `head`, what all tables have in common, and the tables'
/// plots beside it.
void WriteReport(const std::filesystem::path& json, nlohmann::json head,
                 const std::vector<Table>& tables);

}  // namespace choreo
