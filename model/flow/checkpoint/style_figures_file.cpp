#include "model/flow/checkpoint/style_figures_file.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/json_limits.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"
#include "model/messages/figures_path.h"

namespace choreo {
namespace {

constexpr uintmax_t kMaxFiguresBytes = 64 << 10;
constexpr size_t kMaxQuotedBytes = 64;

/// A member of the file, whose path is `field`.
const nlohmann::json& Member(const nlohmann::json& object, const char* name,
                             const std::string& field) {
  if (!object.is_object() || !object.contains(name)) throw InvalidArgument(field, "missing");
  return object[name];
}

Error IsNo(const nlohmann::json& value, const std::string& field, const char* wanted) {
  return InvalidArgument(field,
                         Printable(value.dump().substr(0, kMaxQuotedBytes)) + " is no " + wanted);
}

double Percent(const nlohmann::json& styles, const char* name, const std::string& of_styles) {
  const std::string field = of_styles + '.' + name;
  const nlohmann::json& value = Member(styles, name, field);
  if (!value.is_number()) throw IsNo(value, field, "number");
  const auto percent = value.get<double>();
  if (!(percent >= 0 && percent <= 100))
    throw InvalidArgument(field, InFull(percent) + " % is not in [0, 100]");
  return percent;
}

nlohmann::json ReadJson(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!std::filesystem::is_regular_file(file)) throw InvalidArgument(name, "is no regular file");
  if (const auto bytes = std::filesystem::file_size(file); bytes > kMaxFiguresBytes) {
    throw InvalidArgument(
        name, std::to_string(bytes) + " bytes, the limit is " + std::to_string(kMaxFiguresBytes));
  }
  const std::string text = ReadFile(file);
  CheckJsonDepth(text, name);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InvalidArgument(name, "is not JSON from byte " + std::to_string(error.byte) + " on");
  } catch (const nlohmann::json::exception&) {  // "... number overflow parsing '1e999'"
    throw InvalidArgument(name, "has a number beyond 1.8e308, the largest one");
  }
}

}  // namespace

std::optional<StyleFigures> ReadStyleFigures(const std::filesystem::path& checkpoint,
                                             const std::string& hash) {
  const std::filesystem::path file = StyleFiguresFile(checkpoint);
  const std::string name = file.string();
  try {
    if (!std::filesystem::exists(file)) return std::nullopt;
    const nlohmann::json json = ReadJson(file);
    const std::string of_weights = name + ": weights", of_styles = name + ": styles";
    const nlohmann::json& weights = Member(json, "weights", of_weights);
    if (!weights.is_string()) throw IsNo(weights, of_weights, "text");
    if (weights != hash) {
      throw InvalidArgument(of_weights, weights.dump().substr(0, kMaxQuotedBytes) +
                                            " is another checkpoint's hash; this one's is \"" +
                                            hash + '"');
    }
    const nlohmann::json& styles = Member(json, "styles", of_styles);
    const StyleFigures figures{.recognised = Percent(styles, "recognised", of_styles),
                               .chance = Percent(styles, "chance", of_styles),
                               .low = Percent(styles, "low", of_styles)};
    if (figures.low > figures.recognised) {
      throw InvalidArgument(of_styles + ".low", InFull(figures.low) + " % is above recognised, " +
                                                    InFull(figures.recognised) + " %");
    }
    return figures;
  } catch (const std::filesystem::filesystem_error& error) {
    throw InvalidArgument(name, error.code().message());
  }
}

}  // namespace choreo
