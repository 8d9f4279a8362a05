#include "bench/beat_patterns.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "model/audio/beats/bar_pointer.h"
#include "model/audio/beats/onset.h"
#include "model/audio/music/made_song.h"
#include "model/audio/signal/format.h"

namespace choreo::bench {
namespace {

struct Means {
  std::vector<BarPattern::Bands> sums;
  std::vector<double> counts;
};

void Count(const MadeSong& song, const BarPattern& pattern, Means* means) {
  std::vector<std::array<float, Onset::kBands>> even;
  EvenOnsets evened;
  for (const Onset& onset : FindOnsets(song.mono)) even.push_back(evened.Even(onset));
  size_t in_bar = 0;
  for (size_t i = 0; i + 1 < song.beats.size(); ++i) {
    in_bar = std::ranges::count(song.downbeats, song.beats[i]) > 0 ? 0 : in_bar + 1;
    if (song.beats[i] < 2) continue;  // until levels are known
    const double period = song.beats[i + 1] - song.beats[i];
    for (size_t place = 0; place < pattern.places; ++place) {
      const double second = song.beats[i] + period * pattern.place[place];
      const auto frame = static_cast<int64_t>(std::lround(second * kOnsetRate));
      const size_t at = in_bar * BarPattern::kPlaces + place;
      for (int64_t f = frame - 1; f <= frame + 2 && f < std::ssize(even); ++f) {
        for (size_t band = 0; band < Onset::kBands; ++band)
          means->sums[at][band] += std::max(0.0F, even[static_cast<size_t>(f)][band]);
        ++means->counts[at];
      }
    }
  }
}

}  // namespace

void PrintBarPatterns(uint64_t first_seed, int songs) {
  const auto patterns = BarPatterns();
  for (size_t p = 0; p < patterns.size(); ++p) {
    const BarPattern& pattern = patterns[p];
    Means means;
    means.sums.resize(pattern.rise.size());
    means.counts.resize(pattern.rise.size(), 1e-9);
    for (int i = 0; i < songs; ++i) {
      SongPlan plan;
      plan.seed = first_seed + p * 100'000 + static_cast<uint64_t>(i);
      plan.seconds = 30;
      plan.swing = p == 1;
      plan.meter = p == 2 ? Meter::kThree : p == 3 ? Meter::kSix : Meter::kFour;
      const double slowest = plan.swing ? 60 : 50, fastest = p == 3 ? 115 : 200;
      plan.tempo = {{0, slowest * std::pow(fastest / slowest, (i + 0.5) / songs)}};
      Count(MakeSong(plan), pattern, &means);
    }
    for (size_t at = 0; at < means.sums.size(); ++at) {
      std::printf("%s{", at % BarPattern::kPlaces == 0 ? "\n" : " ");
      for (size_t band = 0; band < Onset::kBands; ++band)
        std::printf("%s%.1f", band == 0 ? "" : ", ", means.sums[at][band] / means.counts[at]);
      std::printf("},");
    }
    std::printf("\n");
  }
}

}  // namespace choreo::bench
