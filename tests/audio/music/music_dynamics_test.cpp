#include "model/audio/music/music_dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/audio/music/feature_stream.h"
#include "model/audio/music/made_song.h"
#include "tests/audio/signals.h"

namespace choreo::music_dynamics_test {

constexpr int kRate = kModelSampleRate;

std::vector<RowSound> RowsOf(std::span<const float> wave, size_t chunk) {
  FeatureStream stream(kRate, 1);
  for (size_t at = 0; at < wave.size(); at += chunk)
    stream.Push(wave.subspan(at, std::min(chunk, wave.size() - at)));
  std::vector<RowSound> rows;
  for (int64_t row = 0; row < stream.final_rows(); ++row) rows.push_back(stream.Sound(row));
  return rows;
}
std::vector<RowSound> RowsOf(std::span<const float> wave) { return RowsOf(wave, wave.size()); }

/// At the end of each second, from the third on.
std::vector<double> EnergiesOf(const std::vector<RowSound>& rows) {
  std::vector<double> energies;
  for (size_t row = 90; row <= rows.size(); row += 30)
    energies.push_back(HearEnergy(std::span(rows).first(row)));
  return energies;
}

double Mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return sum;
}

std::vector<float> Joined(std::initializer_list<std::vector<float>> parts) {
  std::vector<float> song;
  for (const auto& part : parts) song.insert(song.end(), part.begin(), part.end());
  return song;
}

std::vector<float> Drums(double seconds) { return MakeSong({.seed = 7, .seconds = seconds}).mono; }
std::vector<float> Pad(double seconds) {
  return MakeSong({.seed = 7, .seconds = seconds, .only_pad = true}).mono;
}

// BS.1770: a sine of 997 Hz and full scale in one channel has -3.01 LUFS.
TEST(RowSoundTest, ASineIsAsLoudAsTheStandardSays) {
  for (const double amplitude : {1.0, 0.1}) {
    const auto rows = RowsOf(Sine(997, kRate, kRate, amplitude));
    EXPECT_NEAR(Loudness(rows[15].power), -3.01 + 20 * std::log10(amplitude), 0.05);
  }
  // A low tone is less loud, and bass; a high one is louder, by 4 dB, and not bass.
  const RowSound low = RowsOf(Sine(60, kRate, kRate))[15];
  const RowSound high = RowsOf(Sine(4000, kRate, kRate))[15];
  EXPECT_NEAR(low.bass, 0.5, 0.05);
  EXPECT_LT(Loudness(low.power), -4.5);
  EXPECT_LT(high.bass, 1e-6);
  EXPECT_NEAR(Loudness(high.power), -3.01 + 3.3, 0.5);
}

// An offset filled the lowest band, beside which all other sound was too soft.
TEST(RowSoundTest, ADcOffsetIsNotHeard) {
  std::vector<float> song = Drums(10);
  for (float& sample : song) sample *= 0.5F;
  const std::vector<RowSound> rows = RowsOf(song);
  for (float& sample : song) sample += 0.45F;
  const std::vector<RowSound> raised = RowsOf(song, 1000);
  ASSERT_EQ(raised.size(), rows.size());
  std::vector<double> loud, bass;  // by how much they differ: dB
  // The offset begins with a click.
  for (size_t row = RowOnset::kMemory + 2; row < rows.size(); ++row) {
    loud.push_back(std::abs(Loudness(raised[row].power) - Loudness(rows[row].power)));
    bass.push_back(std::abs(Loudness(raised[row].bass) - Loudness(rows[row].bass)));
  }
  EXPECT_LT(Mean(loud), 0.1);
  EXPECT_LT(Mean(bass), 0.5);
}

TEST(MusicDynamicsTest, ADcOffsetIsSilent) {
  const std::vector<RowSound> rows = RowsOf(std::vector<float>(20 * kRate, 0.5F));
  EXPECT_NEAR(HearEnergy(rows), MusicDynamicsOptions().silent, 0.01);
  const std::vector<float> energies = SongEnergies(rows);
  for (size_t step = 3; step < energies.size(); ++step)
    EXPECT_NEAR(energies[step], MusicDynamicsOptions().silent, 0.01) << step;
}

TEST(MusicDynamicsTest, DropExceedsPadAndSilenceIsLeast) {
  const auto energies =
      EnergiesOf(RowsOf(Joined({Pad(20), Drums(20), std::vector<float>(10 * kRate)})));
  const std::span all(energies);
  const double pad = Mean(all.subspan(8, 8)), drop = Mean(all.subspan(19, 6));
  EXPECT_LT(pad, -0.1);
  EXPECT_GT(drop, pad + 0.3);
  EXPECT_NEAR(all.back(), MusicDynamicsOptions().silent, 0.01);
  EXPECT_NEAR(HearEnergy(std::vector<RowSound>(300)), MusicDynamicsOptions().silent, 1e-12);
}

// The last second is still mostly the pad's, and the dance to the drop began calmly.
TEST(MusicDynamicsTest, ADropIsHeardAtOnce) {
  const auto rows = RowsOf(Joined({Pad(20), Drums(5)}));
  const auto until = [&](size_t row) { return std::span(rows).first(row); };
  size_t turn = 20 * 30;
  while (!Turns(HearLevel(until(turn - kLevelRows)), HearLevel(until(turn)))) ++turn;
  EXPECT_GT(HearEnergy(until(turn)), 0.7 * HearEnergy(until(22 * 30)));
  // Music that ends is not: its last echo says little.
  const auto ends = RowsOf(Joined({Drums(20), Pad(5)}));
  EXPECT_LT(HearEnergy(std::span(ends).first(20 * 30 + 25)), 0);
}

TEST(MusicDynamicsTest, SteadyMusicStaysAtTheMiddleAtAnyLoudness) {
  std::vector<float> song = Drums(60);
  const std::vector<double> energies = EnergiesOf(RowsOf(song));
  EXPECT_NEAR(Mean(energies), 0, 0.2);
  for (float& sample : song) sample *= 0.25F;
  const std::vector<double> softer = EnergiesOf(RowsOf(song));
  for (size_t i = 0; i < energies.size(); ++i) EXPECT_NEAR(softer[i], energies[i], 0.05) << i;
}

// Within the range of half a minute a loud part became usual.
TEST(MusicDynamicsTest, ALoudPartOfAMinuteStaysLoud) {
  const auto energies = EnergiesOf(RowsOf(Joined({Pad(40), Drums(60)})));
  EXPECT_GT(Mean(std::span(energies).last(20)), 0.2);
}

TEST(MusicDynamicsTest, AKnownSongRisesWithItsDrop) {
  const auto energies =
      SongEnergies(RowsOf(Joined({Pad(20), Drums(20), std::vector<float>(10 * kRate)})));
  ASSERT_EQ(energies.size(), 100U) << "one each half second";
  const auto mean = [&](int64_t from, int64_t to) { return MeanEnergy(energies, from, to); };
  EXPECT_GT(mean(600, 660), mean(540, 600) + 0.2) << "in the drop's first two seconds";
  EXPECT_NEAR(mean(1300, 1400), MusicDynamicsOptions().silent, 0.05);
}

// A part that returns has the energies that it had, whatever precedes it.
TEST(MusicDynamicsTest, AKnownPartReturnsAsItWas) {
  const auto energies = SongEnergies(RowsOf(Joined({Drums(10), Pad(20), Drums(10), Pad(20)})));
  for (size_t step = 3; step < 17; ++step)
    EXPECT_NEAR(energies[60 + step], energies[step], 0.02) << step;
}

TEST(MusicDynamicsTest, MeanEnergyIsSilentAfterTheSongAndKnowsNothingBeforeIt) {
  const std::vector<float> energies{1, 0.5F};
  EXPECT_EQ(MeanEnergy(energies, 0, 15), 1);
  EXPECT_EQ(MeanEnergy(energies, 0, 30), 0.75);
  EXPECT_EQ(MeanEnergy(energies, -15, 15), 1);
  EXPECT_EQ(MeanEnergy(energies, -60, 0), 0);
  EXPECT_NEAR(MeanEnergy(energies, 30, 90), MusicDynamicsOptions().silent, 1e-9);
  EXPECT_TRUE(SongEnergies({}).empty());
}

TEST(MusicDynamicsTest, NothingIsKnownBeforeTheFirstSecond) {
  EXPECT_EQ(HearEnergy({}), 0);
  const auto rows = RowsOf(Drums(2));
  EXPECT_EQ(HearEnergy(std::span(rows).first(29)), 0);
  EXPECT_NE(HearEnergy(std::span(rows).first(60)), 0);
}

TEST(MusicDynamicsTest, DoesNotDependOnChunksOrStart) {
  const std::vector<float> song = Joined({Pad(8), Drums(124)});
  const auto rows = RowsOf(song);
  const double expected = HearEnergy(rows);
  for (const size_t chunk : {size_t{7}, size_t{735}, size_t{50'000}})
    EXPECT_EQ(HearEnergy(RowsOf(song, chunk)), expected) << chunk;
  constexpr int64_t kRow = kDynamicsMemory + 300;
  const int64_t first =
      FeatureStream::FirstSampleFor(kRow - kDynamicsMemory - kRowSoundMemory, kRate);
  ASSERT_GT(first, 0);
  FeatureStream later(kRate, 1, first);
  later.Push(std::span(song).subspan(static_cast<size_t>(first)));
  std::vector<RowSound> part;
  for (int64_t row = kRow - kDynamicsMemory; row < kRow; ++row) part.push_back(later.Sound(row));
  EXPECT_EQ(HearEnergy(part), HearEnergy(std::span(rows).first(kRow)));
}

}  // namespace choreo::music_dynamics_test
