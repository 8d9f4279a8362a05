#include "server/settings/config_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

#include "model/core/error.h"
#include "server/settings/config_errors.h"

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
    faults_.Add(
        InvalidArgument(At(line), MissingMarks(text, line) + std::string(error.description())));
    return {};
  }
  // It may be unfinished, and all its settings would silently be the defaults.
  if (table.empty())
    faults_.Add(
        InvalidArgument("--config", app_.get_config_ptr()->as<std::string>() +
                                        " sets nothing; leave --config out for the defaults"));
  for (const auto& [key, node] : table) {
    CLI::ConfigItem item;
    item.name = key.str();
    const size_t line = key.source().begin.line;
    lines_[item.name] = line;
    const auto fault = [&](const std::string& what) {
      faults_.Add({ErrorCode::kInvalidArgument, "", At(line) + ": " + what});
    };
    CLI::Option* option = app_.get_option_no_throw("--" + item.name);
    if (option == nullptr) {
      fault(UnknownSetting(app_, item.name));
      continue;
    }
    if (!option->get_configurable()) {
      fault(item.name + " is a flag only");
      continue;
    }
    if (option->count() > 0) {
      overridden_.push_back(item.name);
      continue;
    }
    const auto add = [&](const toml::node& value) {
      const bool is_value = value.is_string() || value.is_number() || value.is_boolean();
      if (is_value) item.inputs.push_back(TextOf(value));
      return is_value;
    };
    const toml::array* list = node.as_array();
    if (!(list ? std::all_of(list->begin(), list->end(), add) : add(node))) {
      fault('"' + item.name +
            "\" is neither a text, a number, true nor false, nor a list of them; there are no "
            "sections");
    } else if (!item.inputs.empty()) {
      Set(item, option);
    }
  }
  return {};
}

void TomlFile::Set(const CLI::ConfigItem& item, CLI::Option* option) const try {
  if (option->get_expected_min() == 0) {
    option->add_result(option->get_flag_value(item.name, to_flag(item)));
  } else {
    option->add_result(item.inputs);
  }
} catch (const CLI::ParseError& error) {
  faults_.Add({ErrorCode::kInvalidArgument, "", PlaceOf(item.name) + error.what()});
}

std::string TomlFile::PlaceOf(const std::string& setting) const {
  const auto line = lines_.find(setting);
  return line == lines_.end() ? "" : At(line->second) + ": ";
}

std::string TomlFile::At(size_t line) const {
  return app_.get_config_ptr()->as<std::string>() + ':' + std::to_string(line);
}

}  // namespace choreo
