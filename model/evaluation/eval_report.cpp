#include "model/evaluation/eval_report.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"

namespace choreo {

std::filesystem::path PictureBeside(const std::filesystem::path& json, std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == ',' || c == '/'; }, '_');
  return std::filesystem::path(json).replace_filename(json.stem().string() + "_" + name + ".png");
}

void CheckReportPath(const std::filesystem::path& json) {
  const auto refuse = [&](const std::string& why) {
    throw InvalidArgument("--json", "'" + json.string() + "' cannot be written: " + why);
  };
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::absolute(json).parent_path(), error);
  if (error) refuse(error.message());
  const AtomicFile probe(json);
  errno = 0;
  if (!std::ofstream(probe.partial(), std::ios::app)) refuse(std::strerror(errno));
}

void WriteReport(const std::filesystem::path& json, nlohmann::json head,
                 const std::vector<Table>& tables) {
  head["tables"] = nlohmann::json::array();
  for (const Table& table : tables) {
    head["tables"].push_back(ToJson(table));
    if (table.plot) DrawPlot(*table.plot, PictureBeside(json, table.name));
  }
  WriteFile(json, head.dump(1) + "\n");
}

}  // namespace choreo
