#include "server/settings/config_file.h"

#include <toml++/toml.h>

#include <iterator>
#include <regex>
#include <sstream>

#include "model/core/error.h"

namespace choreo {
namespace {

/// A value as written on the command line; empty if it has no such form.
std::string TextOf(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<int64_t>()) return std::to_string(*whole);
  if (const auto is_on = node.value_exact<bool>()) return *is_on ? "true" : "false";
  std::ostringstream text;
  if (const auto number = node.value_exact<double>()) text << *number;
  return text.str();
}

bool IsToml(const std::string& line) try {
  static_cast<void>(toml::parse(line));
  return true;
} catch (const toml::parse_error&) {
  return false;
}

/// What an invalid line of TOML probably lacks; empty if unknown. A line that repeats a setting
/// lacks nothing.
std::string MissingMarks(const std::string& text, size_t number) {
  // Matches an address in brackets, too, which begins like a list.
  static const std::regex kBare(R"(^\s*([\w-]+)\s*=\s*(\[[0-9a-fA-F]*:|[^\s"'\[{#]))");
  std::istringstream lines(text);
  std::string line;
  for (size_t i = 0; i < number; ++i) std::getline(lines, line);
  std::smatch found;
  if (!std::regex_search(line, found, kBare) || IsToml(line)) return "";
  return found[1].str() + ": texts need quotation marks; ";
}

}  // namespace

std::vector<CLI::ConfigItem> TomlFile::from_config(std::istream& input) const {
  const std::string text(std::istreambuf_iterator<char>(input), {});
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const size_t line = error.source().begin.line;
    throw InvalidArgument(At(line), MissingMarks(text, line) + std::string(error.description()));
  }
  // It may be unfinished, and all its settings would silently be the defaults.
  if (table.empty())
    throw InvalidArgument("--config", app_.get_config_ptr()->as<std::string>() +
                                          " sets nothing; leave --config out for the defaults");
  std::vector<CLI::ConfigItem> settings;
  for (const auto& [key, node] : table) {
    CLI::ConfigItem item;
    item.name = key.str();
    const size_t line = key.source().begin.line;
    lines_[item.name] = line;
    const CLI::Option* option = app_.get_option_no_throw("--" + item.name);
    if (option != nullptr && option->count() > 0) overridden_.push_back(item.name);
    const auto add = [&](const toml::node& value) {
      if (value.is_table() || value.is_array() || value.is_date() || value.is_time() ||
          value.is_date_time())
        throw InvalidArgument(At(line), '"' + item.name +
                                            "\" is neither a text, a number, true nor false, nor "
                                            "a list of them; there are no sections");
      item.inputs.push_back(TextOf(value));
    };
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& value : *list) add(value);
    } else {
      add(node);
    }
    if (!item.inputs.empty()) settings.push_back(std::move(item));
  }
  return settings;
}

std::string TomlFile::PlaceOf(const std::string& setting) const {
  const auto line = lines_.find(setting);
  return line == lines_.end() ? "" : At(line->second) + ": ";
}

std::string TomlFile::At(size_t line) const {
  return app_.get_config_ptr()->as<std::string>() + ':' + std::to_string(line);
}

}  // namespace choreo
