#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// Where the results of an evaluation go; empty: nowhere.
struct ReportPaths {
  std::filesystem::path json;      ///< plots and sheets go beside it: STEM_NAME.png
  std::filesystem::path markdown;  ///< shows the plots, if there is a JSON file

  /// STEM_NAME.png beside the JSON, NAME without characters that a file's name should not have.
  std::filesystem::path Picture(std::string name) const;
};

/// Makes missing folders, and throws Error(kInvalidArgument) that names the option (--json,
/// --markdown) and the path where a file could not be written, or both are the same file: before
/// the long work, not after.
void CheckReportPaths(const ReportPaths& paths);

/// What all tables have in common.
struct ReportHead {
  std::string model, fingerprint, split, engine, summary;
  double temperature = 0;
};

void WriteReport(const ReportPaths& paths, const ReportHead& head,
                 const std::vector<Table>& tables);

/// Gives the judged method (kServed) the name that its rows and curves shall have.
void NameJudged(const std::string& name, std::vector<Table>* tables);

}  // namespace choreo
