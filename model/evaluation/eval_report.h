#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// STEM_NAME.png beside the JSON file; NAME loses characters that suit no file name.
std::filesystem::path PictureBeside(const std::filesystem::path& json, std::string name);

/// Creates missing folders. Throws Error(kInvalidArgument, "--json") with the path if a file could
/// not be written: before the long work, not after.
void CheckReportPath(const std::filesystem::path& json);

/// Writes the JSON file, starting with `head`, which all tables share, and the tables' plots beside
/// it.
void WriteReport(const std::filesystem::path& json, nlohmann::json head,
                 const std::vector<Table>& tables);

}  // namespace choreo
