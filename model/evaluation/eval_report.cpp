#include "model/evaluation/eval_report.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/evaluation/method.h"

namespace choreo {
namespace {

void CheckWritable(const std::string& option, const std::filesystem::path& path) {
  if (path.empty()) return;
  const auto refuse = [&](const std::string& why) {
    throw InvalidArgument(option, "'" + path.string() + "' cannot be written: " + why);
  };
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::absolute(path).parent_path(), error);
  if (error) refuse(error.message());
  const AtomicFile probe(path);
  errno = 0;
  if (!std::ofstream(probe.partial(), std::ios::app)) refuse(std::strerror(errno));
}

}  // namespace

std::filesystem::path ReportPaths::Picture(std::string name) const {
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == ',' || c == '/'; }, '_');
  std::filesystem::path png = json;
  return png.replace_filename(json.stem().string() + "_" + name + ".png");
}

void CheckReportPaths(const ReportPaths& paths) {
  CheckWritable("--json", paths.json);
  CheckWritable("--markdown", paths.markdown);
  // Folders are there by now, so that links and dots can be followed.
  const auto place = [](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  if (!paths.json.empty() && !paths.markdown.empty() &&
      place(paths.json) == place(paths.markdown)) {
    throw InvalidArgument("--markdown", "'" + paths.markdown.string() +
                                            "' is the same file as --json, which would be lost");
  }
}

void WriteReport(const ReportPaths& paths, const ReportHead& head,
                 const std::vector<Table>& tables) {
  nlohmann::json report = {{"model", head.model},
                           {"fingerprint", head.fingerprint},
                           {"split", head.split},
                           {"temperature", head.temperature},
                           {"engine", head.engine},
                           {"summary", head.summary},
                           {"tables", nlohmann::json::array()}};
  std::string markdown = head.summary + "\n";
  for (const Table& table : tables) {
    report["tables"].push_back(ToJson(table));
    markdown += "\n" + ToMarkdown(table);
    if (!table.plot || paths.json.empty()) continue;
    const std::filesystem::path png = paths.Picture(table.name);
    DrawPlot(*table.plot, png);
    if (paths.markdown.empty()) continue;
    const auto here = std::filesystem::absolute(paths.markdown).parent_path();
    markdown += "\n![" + table.plot->title + "](" +
                std::filesystem::relative(png, here).generic_string() + ")\n";
  }
  if (!paths.json.empty()) WriteFile(paths.json, report.dump(1) + "\n");
  if (!paths.markdown.empty()) WriteFile(paths.markdown, markdown);
}

void NameJudged(const std::string& name, std::vector<Table>* tables) {
  for (Table& table : *tables) {
    for (TableRow& row : table.rows) {
      for (std::string& label : row.labels) {
        // "model", and "model, network alone"
        if (label == kServed || label.starts_with(std::string(kServed) + ", "))
          label.replace(0, std::string(kServed).size(), name);
      }
    }
    if (!table.plot) continue;
    for (PlotSeries& series : table.plot->series)
      if (series.label == kServed) series.label = name;
  }
}

}  // namespace choreo
