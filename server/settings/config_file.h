#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <map>
#include <string>
#include <vector>

#include "server/settings/fault_list.h"

namespace choreo {

/// Reads the TOML file of --config for CLI11. CLI11's own reader reports no line numbers, treats an
/// unclosed quotation mark as text, and stops at the first fault.
class TomlFile final : public CLI::Config {
 public:
  /// `app` must define --config and outlive this.
  explicit TomlFile(CLI::App& app) : app_(app) {}

  /// Gives the settings to their options itself, and returns none. Collects faults: invalid TOML,
  /// unknown settings, values that no setting can have, and a file without any setting.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  std::string to_config(const CLI::App* /*app*/, bool /*defaults*/, bool /*describe*/,
                        std::string /*prefix*/) const override {
    return "";
  }

  /// Those that from_config has found; each begins with "FILE:LINE" or "--config".
  const FaultList& faults() const { return faults_; }
  /// "FILE:LINE: " for a setting in the file, such as "workers"; empty if the file lacks it.
  std::string PlaceOf(const std::string& setting) const;
  /// The settings in the file that flags override.
  const std::vector<std::string>& overridden() const { return overridden_; }

 private:
  void Set(const CLI::ConfigItem& item, CLI::Option* option) const;
  std::string At(size_t line) const;

  CLI::App& app_;
  mutable FaultList faults_;
  mutable std::map<std::string, size_t> lines_;  // of the settings that were read
  mutable std::vector<std::string> overridden_;
};

}  // namespace choreo
