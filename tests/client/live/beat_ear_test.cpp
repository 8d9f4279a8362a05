#include "client/live/beat_ear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/audio/made_song.h"

/// Music that sounds now: its beats are known before they sound.
namespace choreo::live::beat_ear_test {

/// What is told from `from` s on, each beat before it sounds; what is told later counts.
std::vector<double> Told(const std::vector<float>& song, double from) {
  BeatEar ear(kModelSampleRate, 1);
  std::vector<double> told;
  constexpr size_t kPiece = 441;  // 20 ms
  for (size_t at = 0; at < song.size(); at += kPiece) {
    const double now = static_cast<double>(at + kPiece) / kModelSampleRate;
    const auto piece = std::span(song).subspan(at, std::min(kPiece, song.size() - at));
    for (const double beat : ear.Hear(piece)) {
      EXPECT_GT(beat, now - 0.1) << "it has sounded";
      EXPECT_LT(beat, now + BeatEar::kAheadSeconds + 0.1);
      while (!told.empty() && told.back() >= beat - 0.2) told.pop_back();
      told.push_back(beat);
    }
    ear.Wait();
  }
  std::erase_if(told, [from](double beat) { return beat < from; });
  return told;
}

TEST(BeatEar, TellsBeatsBeforeTheySound) {
  for (const double bpm : {90.0, 128.0}) {
    const MadeSong song = MakeSong({.seed = 5, .seconds = 40, .tempo = {{0, bpm}}});
    const std::vector<double> told = Told(song.mono, 15);
    ASSERT_GT(told.size(), 20U) << bpm;
    size_t met = 0;
    for (const double beat : told) {
      met += std::ranges::any_of(song.beats,
                                 [beat](double other) { return std::abs(other - beat) < 0.07; });
    }
    EXPECT_GT(met, told.size() * 8 / 10) << bpm;
  }
}

TEST(BeatEar, TellsNothingOfSilence) {
  EXPECT_TRUE(Told(std::vector<float>(20 * kModelSampleRate), 0).empty());
}

}  // namespace choreo::live::beat_ear_test
