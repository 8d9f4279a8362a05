#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// The path STEM_NAME.png beside the JSON file. Drops characters of NAME that are invalid in file
/// names.
std::filesystem::path PictureBeside(const std::filesystem::path& json, std::string name);

/// Creates missing folders. Throws Error(kInvalidArgument, "--json"), naming the path, if a file
/// could not be written. Call it before the long work.
void CheckReportPath(const std::filesystem::path& json);

/// Writes the JSON file, which begins with `head`, and the tables' plots beside it.
void WriteReport(const std::filesystem::path& json, nlohmann::json head,
                 const std::vector<Table>& tables);

}  // namespace choreo
