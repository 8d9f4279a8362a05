#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "model/core/limits.h"
#include "model/core/passage.h"
#include "model/core/range.h"

/// The parts of a request that say how to dance and what is known of the music. Server, projects,
/// reports and edits share them.
namespace choreo {

/// What the API calls a setting, and the range of one that is a number.
struct SettingRow {
  const char* name;
  Range range = {};
};

/// How to dance. Empty: not stated. docs/extending.md says what another setting needs.
struct DanceManner {
  std::optional<double> temperature = {};  ///< 0 to kMaxTemperature; none: the model's
  std::string style = {};                  ///< one of the model's; empty: any
  /// 0 to 1: how closely the dance's energy follows the music's; none: kDefaultDynamics.
  std::optional<double> music_dynamics = {};
  /// 0 to 1: how much the dance to a repeated passage differs from the dance to the original; none:
  /// kDefaultVariation.
  std::optional<double> variation = {};

  /// Calls visit(SettingRow, the member of each argument...) once per setting. Arguments: structs
  /// with these members.
  static void VisitSettings(const auto& visit, auto&&... each) {
    visit(SettingRow{"temperature", {0, kMaxTemperature}}, each.temperature...);
    visit(SettingRow{"style"}, each.style...);
    visit(SettingRow{"music_dynamics"}, each.music_dynamics...);
    visit(SettingRow{"variation"}, each.variation...);
  }

  /// The range of a number among these settings.
  Range RangeOf(const std::optional<double>& setting) const {
    Range range;
    const auto look = [&](const SettingRow& row, const auto& one) {
      if (static_cast<const void*>(&one) == &setting) range = row.range;
    };
    VisitSettings(look, *this);
    return range;
  }

  /// Checks the numbers that are stated. Throws Error(kInvalidArgument) whose field is `place`
  /// followed by the setting's name.
  void CheckNumbers(const std::string& place) const {
    const auto check = [&place](const SettingRow& row, const auto& setting) {
      if constexpr (requires { setting.has_value(); })
        if (setting) row.range.Check(*setting, place + row.name);
    };
    VisitSettings(check, *this);
  }

  /// Takes `other`'s values for the settings that are empty here.
  void FillFrom(const DanceManner& other) {
    const auto fill = [](const SettingRow&, const auto& from, auto& to) {
      if (to == std::remove_cvref_t<decltype(to)>()) to = from;
    };
    VisitSettings(fill, other, *this);
  }

  double Dynamics() const { return music_dynamics.value_or(kDefaultDynamics); }
  double Variation() const { return variation.value_or(kDefaultVariation); }
};

/// Facts about a dance's music that are known before it starts.
struct KnownMusic {
  /// Times of its beats, seconds, strictly ascending, 0 to 600. Limbs are fastest on beats; events
  /// and the report contain them. Empty: a server finds the beats of a file; for samples it
  /// predicts each transition's beats from the 12 s before it.
  std::vector<double> music_beats = {};
  std::vector<double> music_downbeats = {};  ///< beats that begin a bar; reported, not danced
  /// Identifies the music (MusicId). Each transition's seed is the dance's XOR this, so two songs
  /// differ as two seeds do. 0: unknown; a server computes it for a file.
  uint64_t music_id = 0;
  /// Passages that repeat earlier ones (CheckPassages); the dance repeats with them. Empty: a
  /// server finds a file's.
  std::vector<Passage> music_passages = {};
  /// The energy of the whole song, every half second (SongEnergies in
  /// audio/music/music_dynamics.h), at most kMaxEnergy either way. A transition then has its own
  /// music's energy. Empty: a server measures a file's; for samples it takes the energy before each
  /// transition.
  std::vector<float> music_energies = {};

  /// Calls visit(what the API calls the fact, the member of each argument...) once per fact.
  static void VisitFacts(const auto& visit, auto&&... each) {
    visit("music_beats", each.music_beats...);
    visit("music_downbeats", each.music_downbeats...);
    visit("music_id", each.music_id...);
    visit("music_passages", each.music_passages...);
    visit("music_energies", each.music_energies...);
  }
};

}  // namespace choreo
