#include "client/cli/options/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "client/authoring/fields/counts.h"
#include "client/authoring/fields/json_fields.h"
#include "client/authoring/notes/notes.h"
#include "client/cli/report/dance_settings.h"
#include "model/core/hand_pose.h"
#include "model/core/hit.h"
#include "model/core/limits.h"
#include "model/core/range.h"
#include "model/core/rounded.h"
#include "model/core/text/nearest.h"
#include "model/motion/controls/controls.h"
#include "model/motion/pose/pose_faults.h"

namespace choreo::cli {
namespace {

/// Returns "" for a finite number that satisfies `holds`.
template <typename Predicate>
CLI::Validator NumberThat(const std::string& limit, const std::string& name,
                          const Predicate& holds) {
  return {[limit, holds](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            if (is_number && std::isfinite(value) && holds(value)) return {};
            return text + " is not " + limit;
          },
          name};
}

}  // namespace

const CLI::Validator& AboveZero() {
  static const CLI::Validator kCheck =
      NumberThat("a number above 0", "> 0", [](double value) { return value > 0; });
  return kCheck;
}

CLI::Validator NumberFrom(double low, double high) {
  std::ostringstream limits;
  limits << "a number from " << low << " to " << high;
  return NumberThat(limits.str(), "", [=](double value) { return value >= low && value <= high; });
}

CLI::Validator TimeInSeconds() {
  return NumberThat("a number of seconds from 0 on", "",
                    [](double value) { return value >= 0 && value <= authoring::kMaxSeconds; });
}

void RequireBefore(double from_s, double until_s, const std::string& until) {
  if (from_s < until_s) return;
  throw InvalidArgument(
      "--from", Rounded(from_s) + " s is not before " + until + ", " + Rounded(until_s) + " s");
}

const CLI::Validator& TimeOrCount() {
  static const CLI::Validator kCheck(
      [](const std::string& text) -> std::string {
        try {
          authoring::ParseTime(text, "");
          return {};
        } catch (const Error& error) {
          return error.what();
        }
      },
      "");
  return kCheck;
}

CLI::Validator WholeNumberFrom(int64_t low, int64_t high) {
  return NumberThat("a whole number from " + std::to_string(low) + " to " + std::to_string(high),
                    "", [=](double value) {
                      return value == std::floor(value) && value >= static_cast<double>(low) &&
                             value <= static_cast<double>(high);
                    });
}

CLI::Validator OneOf(const std::vector<std::string>& words) {
  const CLI::Validator member = CLI::IsMember(words);
  return {[member, words](const std::string& text) -> std::string {
            if (std::ranges::find(words, text) != words.end()) return {};
            Nearest meant(text);
            for (const std::string& word : words) meant.Offer(word);
            if (meant.nearest().empty()) return member(text);
            return text + " is not known; did you mean " + meant.nearest() + "?";
          },
          member.get_description()};
}

const CLI::Validator& SongOrNone() {
  static const CLI::Validator kCheck(
      [](std::string& text) -> std::string {
        if (text == kNoSong || CLI::ExistingFile(text).empty()) return {};
        return text + " is not an existing file; " + kNoSong + " stands for no song";
      },
      "FILE|" + std::string(kNoSong));
  return kCheck;
}

void AddSongStart(CLI::App& command, double& seconds) {
  command
      .add_option("--song-start", seconds,
                  "Second of the song at which the dance begins. Earlier music is skipped.")
      ->check(TimeInSeconds());
}

void CheckSongStart(const CLI::App& command, const std::string& song) {
  if (song.empty() && command.count("--song-start") > 0)
    throw CLI::ValidationError("--song-start", "needs a song");
}

void AddAllowBends(CLI::App& command, bool& allowed) {
  command.add_flag("--allow-bends", allowed,
                   "Accept keys that bend a knee or an elbow more than " +
                       Rounded(kBrokenBackwards) +
                       " degrees backwards, or "
                       "beyond " +
                       Rounded(kFolded) + " degrees. Otherwise they are refused.");
}

void AddVmc(CLI::App& command, std::string& address) {
  command.add_option("--vmc", address,
                     "HOST:PORT to stream the dance to in real time, as VMC, for VTuber programs "
                     "and game engines (often port 39539).");
}

void AddManner(CLI::App& command, DanceManner* manner) {
  const auto in_range = [&](const std::optional<double>& setting) {
    const Range range = manner->RangeOf(setting);
    return NumberFrom(range.least, range.most);
  };
  command.add_option(
      "--temperature", manner->temperature,
      "Variety, 0 (calm) to " + Rounded(kMaxTemperature) + "; default: the model's. " + kOfChance);
  command
      .add_option(
          "--music-dynamics", manner->music_dynamics,
          "How much the music's energy shapes that of the dance, 0 (not at all) to 1. Default: " +
              Rounded(kDefaultDynamics) + ".")
      ->check(in_range(manner->music_dynamics));
  command
      .add_option("--variation", manner->variation,
                  "How much the dance differs where a passage of the music returns, 0 (hardly) to "
                  "1 (altogether). Default: " +
                      Rounded(kDefaultVariation) + ".")
      ->check(in_range(manner->variation));
  command
      .add_option("--style", manner->style,
                  "A style that `choreo info` lists, such as happy or tired. The list says which "
                  "hardly show, as all styles of the model default. Default: none.")
      ->check([](const std::string& name) {
        return name.empty() ? std::string("is empty; leave it out for no style") : std::string();
      });
}

void AddHit(CLI::App& command, std::optional<double>& hit, const std::string& whose) {
  command
      .add_option("--hit", hit,
                  "How hard " + whose + " hit, 0 (gently) to " + Rounded(kMaxHit) +
                      " (late and fast); the dancer comes to rest there. Default: as the key file "
                      "says, else danced through.")
      ->check(NumberFrom(0, kMaxHit));
}

void AddHands(CLI::App& command, std::string& hands, const std::string& what) {
  command.add_option("--hands", hands, what + ": " + HandPoseNames() + ".")
      ->check(OneOf({kHandPoseNames.begin(), kHandPoseNames.end()}));
}

void AddModel(CLI::App& command, std::string& model) {
  command.add_option("-m,--model", model, "Model of the server. Default: its first.");
}

Error AsTyped(const Error& error) {
  static const std::map<std::string_view, std::string> kOptions = {
      {"addresses", "--server"},
      {"beats", "--beats"},
      {"ca_certificate", "--ca"},
      {"camera", "--camera"},
      {"client_certificate", "--client-cert"},
      {"client_key", "--client-key"},
      {"downbeat", "--downbeat"},
      {"keyframes", "--keyframes"},
      {"seconds", "--seconds"},
      {"song_start", "--song-start"},
      {"token_file", "--token-file"},
      {"velocity_factors.reference", "--velocity-reference"},
      {"video.fps", "--fps"},
      {"video.height", "--size"},
      {"video.width", "--size"},
  };
  if (error.remedy() == Remedy::kTakePart) {
    return Error(error.code(), error.field(),
                 std::string(error.Of("").what()) + " (--song-start, --seconds)");
  }
  const auto control = std::ranges::find(kControls, error.field(), &ControlRow::name);
  if (control != std::end(kControls)) return error.Of(std::string(control->option));
  const auto option = kOptions.find(error.field());
  if (option != kOptions.end()) return error.Of(option->second);
  std::string of_setting;
  const auto find = [&](const SettingRow& row, const auto&) {
    std::string name = row.name;
    if (error.field() != "config." + name) return;
    std::ranges::replace(name, '_', '-');
    of_setting = "--" + name;
  };
  DanceManner::VisitSettings(find, DanceManner());
  return of_setting.empty() ? error : error.Of(of_setting);
}

void Hide(CLI::App& command, const std::string& name) {
  CLI::Option* hidden = command.get_option(name)->group("");
  for (CLI::Option* other : command.get_options()) other->remove_excludes(hidden);
}

void NoteStyle(const client::ModelDescription& model, const std::string& style) {
  const auto& figures = model.style_figures;
  const bool is_one = std::ranges::find(model.styles, style) != model.styles.end();
  if (!is_one || !figures || figures->shows()) return;
  authoring::Note("note: --style " + style + " hardly shows: the styles of the model \"" +
                  model.name + "\" change its dances, but people do not see which it is");
}

void NoteDeterministic(const client::ModelDescription& model,
                       std::initializer_list<std::pair<std::string_view, bool>> options) {
  if (!model.deterministic) return;
  for (const auto& [name, is_given] : options) {
    if (!is_given) continue;
    authoring::Note("note: the model \"" + model.name + "\" is deterministic; " +
                    std::string(name) + " changes nothing");
  }
}

CLI::Option* AddSeed(CLI::App& command, std::optional<uint64_t>& seed, const std::string& help) {
  static const CLI::Validator kCheck(
      [](const std::string& text) -> std::string {
        uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, code] = std::from_chars(text.data(), end, value);
        if (code == std::errc() && stop == end) return {};
        return text + " is not a whole number from 0 to 18446744073709551615";
      },
      "");
  return command.add_option("--seed", seed, help)->check(kCheck);
}

}  // namespace choreo::cli
