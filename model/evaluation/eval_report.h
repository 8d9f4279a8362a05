#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// STEM_NAME.png beside the JSON file, NAME without characters that a file's name should not have.
std::filesystem::path PictureBeside(const std::filesystem::path& json, std::string name);

/// Makes missing folders, and throws Error(kInvalidArgument, "--json") with the path where a file
/// could not be written: before the long work, not after.
void CheckReportPath(const std::filesystem::path& json);

/// What all tables have in common.
struct ReportHead {
  std::string model, fingerprint, split, engine, summary;
  double temperature = 0;
};

/// Writes the JSON file, and the tables' plots beside it.
void WriteReport(const std::filesystem::path& json, const ReportHead& head,
                 const std::vector<Table>& tables);

}  // namespace choreo
