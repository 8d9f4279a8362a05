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

/// Options that several commands share, and validators with readable messages.
namespace choreo::cli {

/// Accepts a number above 0.
const CLI::Validator& AboveZero();
/// Accepts a number of seconds, 0 to kMaxSeconds.
CLI::Validator TimeInSeconds();
/// Throws Error(kInvalidArgument, "--from") unless a part begins before it ends. `until`: the
/// option that says its end.
void RequireBefore(double from_s, double until_s, const std::string& until = "--until");
/// Accepts a time in seconds or counts (counts.h).
const CLI::Validator& TimeOrCount();

/// Accept a number, or a whole number, within these limits.
CLI::Validator NumberFrom(double low, double high);
CLI::Validator WholeNumberFrom(int64_t low, int64_t high);

/// Accepts one of these words. The message suggests the word that a misspelt one may mean.
CLI::Validator OneOf(const std::vector<std::string>& words);
/// Accepts the file of a song, or kNoSong.
const CLI::Validator& SongOrNone();

/// Adds `--song-start`, seconds.
void AddSongStart(CLI::App& command, double& seconds);
/// Throws CLI::ValidationError if `--song-start` is given without a song.
void CheckSongStart(const CLI::App& command, const std::string& song);

/// Adds `--allow-bends`.
void AddAllowBends(CLI::App& command, bool& allowed);

/// Adds `--hit`. `whose`: the subject of its help, "the poses of --key are" or "the end is".
void AddHit(CLI::App& command, std::optional<double>& hit, const std::string& whose);

/// Adds `--hands`, one of kHandPoseNames. `what`: the beginning of its help, before the choice.
void AddHands(CLI::App& command, std::string& hands, const std::string& what);

/// Adds `--vmc`, HOST:PORT.
void AddVmc(CLI::App& command, std::string& address);

/// Adds `--temperature`, `--music-dynamics`, `--variation` and `--style` (as in `choreo info`).
void AddManner(CLI::App& command, DanceManner* manner);

/// Adds `--model`, one of the server's models.
void AddModel(CLI::App& command, std::string& model);
/// The last sentence of the help of options that only choose among possible dances.
inline const std::string kOfChance = "No effect if `choreo info` calls the model deterministic.";
/// Prints a note if the requested style does not show in this model's dances.
void NoteStyle(const client::ModelDescription& model, const std::string& style);
/// Prints a note if the model is deterministic and any of these options, which affect only chance,
/// is given. `options`: names, and whether each is given.
void NoteDeterministic(const client::ModelDescription& model,
                       std::initializer_list<std::pair<std::string_view, bool>> options);

/// Adds `--seed`, an unsigned integer of 64 bits.
CLI::Option* AddSeed(CLI::App& command, std::optional<uint64_t>& seed, const std::string& help);

/// Replaces the library's or server's name of a setting in an error with its option.
Error AsTyped(const Error& error);

/// Hides an option that a command refuses (and says why) from its help and other options' help.
void Hide(CLI::App& command, const std::string& name);

/// Adds an option that may be repeated. Each occurrence takes one value, so that another argument,
/// such as a song, may follow.
template <typename Value>
CLI::Option* AddRepeated(CLI::App& command, const std::string& name, std::vector<Value>& values,
                         const std::string& help) {
  return command.add_option(name, values, help)->allow_extra_args(false);
}

}  // namespace choreo::cli
