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
#include "client/dance_config.h"

/// Options shared by several commands, and checks with readable messages.
namespace choreo::cli {

/// A number above 0.
const CLI::Validator& AboveZero();
/// A time, 0 to kMaxSeconds.
CLI::Validator TimeInSeconds();
/// A time in seconds or counts (counts.h).
const CLI::Validator& TimeOrCount();

/// A number within these limits, and a whole one.
CLI::Validator NumberFrom(double low, double high);
CLI::Validator WholeNumberFrom(int64_t low, int64_t high);

/// One of these words; the message names the one that a misspelt word may mean.
CLI::Validator OneOf(const std::vector<std::string>& words);
/// The file of a song, or kNoSong.
const CLI::Validator& SongOrNone();

/// `--song-start`, seconds.
void AddSongStart(CLI::App& command, double& seconds);
/// Throws CLI::ValidationError if it is given without a song.
void CheckSongStart(const CLI::App& command, const std::string& song);

/// `--allow-bends`.
void AddAllowBends(CLI::App& command, bool& allowed);

/// `--hit`; `whose`: "the poses of --key are", "the end is".
void AddHit(CLI::App& command, std::optional<double>& hit, const std::string& whose);

/// `--hands`, one of kHandPoseNames, after which the text names the choice.
void AddHands(CLI::App& command, std::string& hands, const std::string& what);

/// `--vmc`, HOST:PORT.
void AddVmc(CLI::App& command, std::string& address);

/// `--temperature`, `--music-dynamics`, `--variation`, and `--style`, one that `choreo info` lists.
void AddManner(CLI::App& command, DanceManner* manner);

/// `--model`, one of the server's.
void AddModel(CLI::App& command, std::string& model);
/// The end of the help of all options that choose among dances.
inline const std::string kOfChance =
    "Changes nothing where `choreo info` calls the model deterministic.";
/// Notes that a style which was asked for does not show with this model.
void NoteStyle(const client::ModelDescription& model, const std::string& style);
/// Notes to users of such options, each with whether it is given, that a model is deterministic.
void NoteDeterministic(const client::ModelDescription& model,
                       std::initializer_list<std::pair<std::string_view, bool>> options);

/// `--seed`: a whole number of 64 bits, never negative.
CLI::Option* AddSeed(CLI::App& command, std::optional<uint64_t>& seed, const std::string& help);

/// Replaces the library's or server's name of a setting in an error by its option.
Error AsTyped(const Error& error);

/// An option that may be repeated. Each takes one value; another argument may follow, such as a
/// song.
template <typename Value>
CLI::Option* AddRepeated(CLI::App& command, const std::string& name, std::vector<Value>& values,
                         const std::string& help) {
  return command.add_option(name, values, help)->allow_extra_args(false);
}

}  // namespace choreo::cli
