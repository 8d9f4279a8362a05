#include "model/flow/style_figures_file.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/json_limits.h"
#include "model/core/rounded.h"

namespace choreo {
namespace {

constexpr uintmax_t kMaxFiguresBytes = 64 << 10;

}  // namespace

std::optional<StyleFigures> ReadStyleFigures(const std::filesystem::path& checkpoint,
                                             const std::string& hash) {
  const std::filesystem::path file =
      std::filesystem::path(checkpoint).replace_extension(".figures.json");
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;
  if (const auto bytes = std::filesystem::file_size(file, none);
      !none && bytes > kMaxFiguresBytes) {
    throw InvalidArgument(file.string(),
                          "more than " + std::to_string(kMaxFiguresBytes) + " bytes");
  }
  try {
    const std::string text = ReadFile(file);
    CheckJsonDepth(text, file.string());
    const auto json = nlohmann::json::parse(text);
    if (json.at("weights").get<std::string>() != hash) return std::nullopt;
    const auto figure = [&](const char* name) { return json.at("styles").at(name).get<double>(); };
    const StyleFigures figures{figure("recognised"), figure("chance"), figure("low")};
    for (const double percent : {figures.chance, figures.low, figures.recognised}) {
      if (!(percent >= 0 && percent <= 100))
        throw InvalidArgument(file.string(), InFull(percent) + " % is not in [0, 100]");
    }
    if (figures.low > figures.recognised)
      throw InvalidArgument(file.string(), "low is above recognised");
    return figures;
  } catch (const nlohmann::json::exception& error) {
    throw InvalidArgument(file.string(), std::string("can't be read: ") + error.what());
  }
}

}  // namespace choreo
