#include "model/audio/pulse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "model/core/grid.h"

namespace choreo {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// ---- Normalised onsets.
constexpr double kMeanSeconds = 1;   // averaging time of the steady noise that is subtracted
constexpr double kLevelSeconds = 3;  // averaging time of the level that onsets are divided by
constexpr double kQuietDb = 0.02;    // mean rise per band and row below which a band is silent
constexpr double kLoudest = 8;       // times the mean; caps the weight of a crash

// ---- The bank. Tempi are steps of 1/64 octave above kSlowestBpm.
constexpr double kSlowestBpm = 60;
constexpr size_t kOctave = 64, kTempi = 7 * kOctave / 4, kResonators = kTempi + 2 * kOctave;
constexpr double kRingSeconds = 3.5;  // decay time of a resonator
constexpr std::array<double, 3> kParts{1, 1,
                                       0.5};  // weights of beats, half beats and quarter beats

// ---- The choice.
constexpr double kLikelyBpm = 100,
                 kLikelyOctaves = 0.6;  // the tempo that people tap, and its deviation
constexpr size_t kPhases = 96;
constexpr int kChoiceRows = 3;  // rows between searches for the pulse
constexpr double kClearlyBetter = 1.15;
constexpr double kPatienceRows = 30;  // rows for which another pulse must be better

// ---- Trust.
constexpr size_t kAhead = 30;        // rows between predicting a beat and hearing it
constexpr double kTrustSeconds = 5;  // averaging time
constexpr double kDoubtRows = 30;    // prior: this many average onsets off the beat
constexpr double kLeastConfidence = 0.13;
constexpr int kSilentRows = 75;  // rows without an onset after which the music has stopped

double Kept(double seconds) { return std::exp(-1 / (kModelFps * seconds)); }

// Each resonator's decay and rotation per row; the prior of each tempo; the phases of a beat as
// phasors.
struct PulseTables {
  std::array<double, kResonators> turn_re, turn_im;
  std::array<double, kTempi> likely;
  std::array<std::pair<double, double>, kPhases> phasors;

  PulseTables() {
    for (size_t k = 0; k < kResonators; ++k) {
      const double angle = kTwoPi / PeriodOf(static_cast<double>(k));
      turn_re[k] = Kept(kRingSeconds) * std::cos(angle);
      turn_im[k] = Kept(kRingSeconds) * std::sin(angle);
    }
    for (size_t k = 0; k < kTempi; ++k) {
      const double octaves = std::log2(kSlowestBpm / kLikelyBpm) +
                             static_cast<double>(k) / static_cast<double>(kOctave);
      likely[k] = std::exp(-0.5 * octaves * octaves / (kLikelyOctaves * kLikelyOctaves));
    }
    for (size_t i = 0; i < kPhases; ++i) {
      const double angle = kTwoPi * static_cast<double>(i) / kPhases;
      phasors[i] = {std::cos(angle), std::sin(angle)};
    }
  }

  // In rows.
  static double PeriodOf(double step) {
    return 60 * kModelFps / (kSlowestBpm * std::exp2(step / static_cast<double>(kOctave)));
  }
};

const PulseTables kTables;

// A tempo, the last row's phase in the beat, and their strength.
struct Choice {
  size_t tempo = 0, phase = 0;
  double strength = 0;
};

class Listener {
 public:
  void Hear(double onset) {
    const double kept = Kept(kMeanSeconds), level_kept = Kept(kLevelSeconds);
    mean_ = rows_ == 0 ? onset : kept * mean_ + (1 - kept) * onset;
    const double over = std::max(0.0, onset - mean_);
    level_ = level_kept * level_ + (1 - level_kept) * over;
    const double even = level_ > kQuietDb ? std::min(over / level_, kLoudest) : 0;
    silent_rows_ = even > 0 ? 0 : silent_rows_ + 1;
    Ring(even);
    Judge(even);
    if (rows_ % kChoiceRows == 0) Choose();
    if (pulse_.period > 0 && rows_ % kChoiceRows != 0) --pulse_.next;
    while (pulse_.period > 0 && pulse_.next <= 0) pulse_.next += pulse_.period;
    said_[rows_ % kAhead] = pulse_;
    ++rows_;
  }

  Pulse Heard() const {
    Pulse pulse = pulse_;
    if (pulse.period > 0 && silent_rows_ < kSilentRows)
      pulse.confidence = std::clamp(met_ / (heard_ + kDoubtRows), 0.0, 1.0);
    return pulse;
  }

 private:
  void Ring(double onset) {
    for (size_t k = 0; k < kResonators; ++k) {
      const double re = re_[k] * kTables.turn_re[k] - im_[k] * kTables.turn_im[k] + onset;
      im_[k] = re_[k] * kTables.turn_im[k] + im_[k] * kTables.turn_re[k];
      re_[k] = re;
    }
  }

  // Scores the earlier prediction: onsets on the beat count for it, onsets halfway between count
  // against it.
  void Judge(double onset) {
    if (rows_ < kAhead) return;
    const Pulse& then = said_[rows_ % kAhead];
    if (then.period == 0) return;
    const double phase = kTwoPi * (static_cast<double>(kAhead) - then.next) / then.period;
    const double kept = Kept(kTrustSeconds);
    double near = 0;
    for (size_t part = 0; part < kParts.size(); ++part)
      near += kParts[part] * std::cos(phase * static_cast<double>(1 << part));
    met_ = kept * met_ + onset * near / (kParts[0] + kParts[1] + kParts[2]);
    heard_ = kept * heard_ + onset;
  }

  double Strength(size_t tempo, size_t phase) const {
    double sum = 0;
    for (size_t part = 0; part < kParts.size(); ++part) {
      const size_t k = tempo + part * kOctave;
      const auto& [cosine, sine] = kTables.phasors[(phase << part) % kPhases];
      sum += kParts[part] * (re_[k] * cosine + im_[k] * sine);
    }
    return sum;
  }

  // The best of some tempi and of all phases, or of those near one.
  Choice Best(size_t from, size_t to, size_t phase, size_t phases) const {
    // An upper bound per tempo, reached if all its parts agree. Searched from the highest bound,
    // few tempi need a full look.
    std::array<double, kTempi> most;
    for (size_t tempo = from; tempo < to; ++tempo) {
      double sum = 0;
      for (size_t part = 0; part < kParts.size(); ++part) {
        const size_t k = tempo + part * kOctave;
        sum += kParts[part] * std::sqrt(re_[k] * re_[k] + im_[k] * im_[k]);
      }
      most[tempo] = sum * kTables.likely[tempo];
    }
    Choice best;
    const auto look = [&](size_t tempo) {
      for (size_t i = 0; i < phases; ++i) {
        const size_t at = (phase + i) % kPhases;
        const double strength = Strength(tempo, at) * kTables.likely[tempo];
        if (strength > best.strength) best = {tempo, at, strength};
      }
    };
    const auto first = std::max_element(most.begin() + static_cast<std::ptrdiff_t>(from),
                                        most.begin() + static_cast<std::ptrdiff_t>(to));
    const auto promising = static_cast<size_t>(first - most.begin());
    look(promising);
    for (size_t tempo = from; tempo < to; ++tempo)
      if (tempo != promising && most[tempo] > best.strength) look(tempo);
    return best;
  }

  void Choose() {
    constexpr size_t kNear = 8;
    Choice choice = Best(0, kTempi, 0, kPhases);
    if (pulse_.period > 0) {
      // The present pulse, advanced to this row.
      const double turns = (pulse_.period - pulse_.next + 1) / pulse_.period;
      const auto phase = static_cast<size_t>(std::lround(turns * kPhases)) % kPhases;
      const size_t least = tempo_ < 2 ? 0 : tempo_ - 2;
      const Choice same =
          Best(least, std::min(tempo_ + 3, kTempi), phase + kPhases - kNear, 2 * kNear + 1);
      const bool better = choice.strength > kClearlyBetter * same.strength;
      rival_rows_ = std::max(0.0, rival_rows_ + (better ? kChoiceRows : -kChoiceRows));
      if (rival_rows_ < kPatienceRows && same.strength > 0) {
        choice = same;
      } else {
        rival_rows_ = 0;
      }
    }
    Take(choice);
  }

  // The summit of the parabola through neighbouring steps of tempo or phase.
  static double Summit(double left, double middle, double right) {
    const double bend = left - 2 * middle + right;
    return bend < 0 ? std::clamp(0.5 * (left - right) / bend, -0.5, 0.5) : 0;
  }

  void Take(const Choice& choice) {
    pulse_ = {};
    if (choice.strength <= 0) return;
    const auto [tempo, phase, strength] = choice;
    tempo_ = tempo;
    double step = static_cast<double>(tempo);
    const size_t around = phase + kPhases - 6;
    const auto strongest = [&](size_t at) {
      double most = Strength(at, around);
      for (size_t i = 1; i <= 12; ++i) most = std::max(most, Strength(at, around + i));
      return most;
    };
    if (tempo > 0 && tempo + 1 < kTempi)
      step += Summit(strongest(tempo - 1), strongest(tempo), strongest(tempo + 1));
    const double turns =
        (static_cast<double>(phase) + Summit(Strength(tempo, phase + kPhases - 1),
                                             Strength(tempo, phase), Strength(tempo, phase + 1))) /
        kPhases;
    pulse_.period = PulseTables::PeriodOf(step);
    pulse_.next = (1 - turns) * pulse_.period;
  }

  size_t rows_ = 0;
  double mean_ = 0, level_ = 0;
  std::array<double, kResonators> re_{}, im_{};
  Pulse pulse_;
  size_t tempo_ = 0;
  double rival_rows_ = 0;
  std::array<Pulse, kAhead> said_{};
  double met_ = 0, heard_ = 0;
  int silent_rows_ = 0;
};

}  // namespace

bool Pulse::Certain() const { return confidence >= kLeastConfidence; }

Pulse HearPulse(std::span<const float> onsets) {
  Listener listener;
  for (const float onset : onsets.last(std::min<size_t>(onsets.size(), kPulseMemory)))
    listener.Hear(onset);
  return listener.Heard();
}

}  // namespace choreo
