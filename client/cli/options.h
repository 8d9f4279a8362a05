#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/choreo_client.h"

/// Options that several commands have, and checks whose words people understand.
namespace choreo::cli {

/// A number above 0.
const CLI::Validator& AboveZero();
/// A time, 0 to kMaxSeconds.
CLI::Validator TimeInSeconds();

/// A number within these limits, and a whole one.
CLI::Validator NumberFrom(double low, double high);
CLI::Validator WholeNumberFrom(int64_t low, int64_t high);

/// `--song-start`, seconds.
void AddSongStart(CLI::App& command, double& seconds);
/// Throws CLI::ValidationError where it is given and there is no song.
void CheckSongStart(const CLI::App& command, const std::string& song);

/// `--allow-bends`.
void AddAllowBends(CLI::App& command, bool& allowed);

/// `--vmc`, HOST:PORT.
void AddVmc(CLI::App& command, std::string& address);

/// `--music-dynamics`.
void AddMusicDynamics(CLI::App& command, std::optional<double>& share);

/// `--variation`.
void AddVariation(CLI::App& command, std::optional<double>& variation);

/// `--temperature`.
void AddTemperature(CLI::App& command, std::optional<double>& temperature);
/// `--model`, one of the server's.
void AddModel(CLI::App& command, std::string& model);
/// `--style`, one that `choreo info` lists.
void AddStyle(CLI::App& command, std::string& style);
/// What the help of every option says that chooses among dances.
inline const std::string kOfChance =
    "Changes nothing where `choreo info` calls the model deterministic.";
/// Tells whoever gives such an option, each with whether it is given, to a deterministic model.
void NoteDeterministic(const client::ModelDescription& model,
                       std::initializer_list<std::pair<std::string_view, bool>> options);

/// `--seed`: a whole number of 64 bits, never negative.
CLI::Option* AddSeed(CLI::App& command, std::optional<uint64_t>& seed, const std::string& help);

/// An error of what an option sets, as the library or the server names it, by the option's name.
Error AsTyped(const Error& error);

/// An option that may be given more than once. Each takes one value: what follows is another
/// argument, such as a song.
template <typename Value>
CLI::Option* AddRepeated(CLI::App& command, const std::string& name, std::vector<Value>& values,
                         const std::string& help) {
  return command.add_option(name, values, help)->allow_extra_args(false);
}

}  // namespace choreo::cli
