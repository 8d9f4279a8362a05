#include "model/flow/style_figures_file.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/json_limits.h"

namespace choreo {
namespace {

constexpr uintmax_t kMaxFiguresBytes = 64 << 10;

}  // namespace

std::optional<StyleFigures> ReadStyleFigures(const std::filesystem::path& checkpoint,
                                             const std::string& hash) {
  const std::filesystem::path file =
      std::filesystem::path(checkpoint).replace_extension(".figures.json");
  if (!std::filesystem::is_regular_file(file)) return std::nullopt;
  if (std::filesystem::file_size(file) > kMaxFiguresBytes) {
    throw InvalidArgument(file.string(),
                          "more than " + std::to_string(kMaxFiguresBytes) + " bytes");
  }
  try {
    const std::string text = ReadFile(file);
    CheckJsonDepth(text, file.string());
    const auto json = nlohmann::json::parse(text);
    if (json.at("weights").get<std::string>() != hash) return std::nullopt;
    const auto figure = [&](const char* name) { return json.at("styles").at(name).get<double>(); };
    return StyleFigures{figure("recognised"), figure("chance"), figure("low")};
  } catch (const nlohmann::json::exception& error) {
    throw InvalidArgument(file.string(), std::string("can't be read: ") + error.what());
  }
}

}  // namespace choreo
