#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <map>
#include <string>
#include <vector>

namespace choreo {

/// Reads the TOML file of --config for CLI11. CLI11's own reader reports no line numbers and treats
/// an unclosed quotation mark as text.
class TomlFile final : public CLI::Config {
 public:
  /// `app` must define --config and outlive this.
  explicit TomlFile(const CLI::App& app) : app_(app) {}

  /// Throws Error(kInvalidArgument, "FILE:LINE") for invalid TOML and for values that no setting
  /// can have, and Error(kInvalidArgument, "--config") for a file without any setting.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  std::string to_config(const CLI::App* /*app*/, bool /*defaults*/, bool /*describe*/,
                        std::string /*prefix*/) const override {
    return "";
  }

  /// "FILE:LINE: " for a setting in the file, such as "workers"; empty if the file lacks it.
  std::string PlaceOf(const std::string& setting) const;
  /// The settings in the file that flags override.
  const std::vector<std::string>& overridden() const { return overridden_; }

 private:
  std::string At(size_t line) const;

  const CLI::App& app_;
  mutable std::map<std::string, size_t> lines_;  // of the settings that were read
  mutable std::vector<std::string> overridden_;
};

}  // namespace choreo
