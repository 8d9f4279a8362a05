#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <map>
#include <string>
#include <vector>

namespace choreo {

/// Reads the file of --config, which is TOML, for CLI11. Its own reader knows no lines, and takes
/// an open quotation mark for a part of the text.
class TomlFile final : public CLI::Config {
 public:
  /// `app` has --config, and outlives this.
  explicit TomlFile(const CLI::App& app) : app_(app) {}

  /// Throws Error(kInvalidArgument, "FILE:LINE") for what is no TOML or cannot be a setting.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  std::string to_config(const CLI::App* /*app*/, bool /*defaults*/, bool /*describe*/,
                        std::string /*prefix*/) const override {
    return "";
  }

  /// "FILE:LINE: " of a setting, such as "workers", that the file has; else empty.
  std::string PlaceOf(const std::string& setting) const;

 private:
  std::string At(size_t line) const;

  const CLI::App& app_;
  mutable std::map<std::string, size_t> lines_;  // of the settings that were read
};

}  // namespace choreo
