#include "model/evaluation/tables/beat_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/audio/beats/beats.h"
#include "model/metrics/song_beats.h"
#include "model/motion/kinematics/kinematic_beats.h"

namespace choreo {

BeatFigures ScoreBeats(std::span<const float> speeds, const std::vector<double>& music,
                       double fps) {
  BeatFigures figures;
  const std::vector<int64_t> kinematic = KinematicBeats(speeds, fps);
  const std::vector<double> beats = BeatsBetween(music, 0, static_cast<int>(speeds.size()) + 1);
  if (kinematic.empty() || beats.empty()) return figures;
  const auto hits = std::ranges::count_if(kinematic, [&](int64_t frame) {
    return std::ranges::any_of(beats, [&](double beat) {
      // A beat is a whole frame, as in the paper.
      return std::abs(std::round(beat) - static_cast<double>(frame)) <= kBeatGap;
    });
  });
  const auto count = static_cast<double>(kinematic.size());
  figures.hit_rate = static_cast<double>(hits) / count;
  figures.coverage = count / beats.size();
  figures.alignment = BeatAlignmentScore(speeds, beats, fps);
  return figures;
}

void BeatTable::Add(const std::string& name, size_t clip, int start,
                    const std::vector<float>& speeds) {
  const auto frames = static_cast<int>(speeds.size()) + 1;
  const std::vector<double> own = set_.BeatsBetween(clip, start, frames);
  if (own.empty()) return;
  const double fps = set_.clips[clip].motion.fps;
  Entry entry{clip, ScoreBeats(speeds, own, fps), {}};
  int others = 0;
  for (size_t other = 0; other < set_.beats.size(); ++other) {
    if (other == clip || set_.beats[other].empty()) continue;
    // Scores the part of the dance that the other song covers.
    const auto length =
        std::min(speeds.size(), static_cast<size_t>(set_.clips[other].audio.cols()) - 1);
    const BeatFigures figures = ScoreBeats(std::span(speeds).first(length), set_.beats[other], fps);
    entry.chance.hit_rate += figures.hit_rate;
    entry.chance.alignment += figures.alignment;
    ++others;
  }
  entry.chance.hit_rate = others > 0 ? entry.chance.hit_rate / others : NAN;
  entry.chance.alignment = others > 0 ? entry.chance.alignment / others : NAN;
  auto row = std::ranges::find(rows_, name, &Row::name);
  if (row == rows_.end())
    row = rows_.insert(name == "real" ? rows_.begin() : rows_.end(), {name, {}});
  row->entries.push_back(entry);
}

Table BeatTable::Finish() const {
  Table table;
  table.name = "beats_" + set_.name;
  table.title = "Steps on beats, " + set_.name;
  table.note =
      "Kinematic beats are maxima of the mean joint speed, smoothed by a Gaussian of 1/12 s; hits "
      "are at most two frames off a music beat, as it was found in the song's MFCC rows and "
      "told to the model. Coverage: kinematic beats over music beats. Chance: the same dances "
      "scored on the set's other songs. Alignment (AIST++): of the frames that are the slowest "
      "within 1/6 s on each side, sigma 0.05 s. Intervals over songs.";
  table.label_headings = {"dance"};
  double real_coverage = NAN;
  Plot plot{.title = "Beat hit rate, song by song, " + set_.name,
            .x_label = "song",
            .y_label = "% of kinematic beats",
            .series = {}};
  for (const PreparedClip& clip : set_.clips) plot.x_names.push_back(clip.name);
  for (const Row& row : rows_) {
    const auto put = [&](const char* heading, int digits, auto figure) {
      table.Put(heading, digits, Mean(row.entries, figure));
    };
    table.AddRow({row.name});
    table.Put("dances", 0, static_cast<double>(row.entries.size()));
    const auto hit_rate = [](const Entry& one) { return 100 * one.own.hit_rate; };
    put("hit rate %", 1, hit_rate);
    put("chance %", 1, [](const auto& one) { return 100 * one.chance.hit_rate; });
    put("above chance", 1,
        [](const auto& one) { return 100 * (one.own.hit_rate - one.chance.hit_rate); });
    put("coverage", 2, [](const auto& one) { return one.own.coverage; });
    const double coverage = table.rows.back().cells.back().value;
    if (row.name == "real") real_coverage = coverage;
    table.Put("coverage / real's", 2, coverage / real_coverage);
    put("alignment", 3, [](const auto& one) { return one.own.alignment; });
    put("its chance", 3, [](const auto& one) { return one.chance.alignment; });
    PlotSeries own{.label = row.name, .x = {}, .y = {}};
    std::map<size_t, std::vector<ClipFigure>> songs;
    for (const ClipFigure& hit : FiguresOf(row.entries, hit_rate)) songs[hit.clip].push_back(hit);
    for (const auto& [song, hits] : songs) {
      own.x.push_back(static_cast<double>(song));
      own.y.push_back(Mean(hits).value);
    }
    plot.series.push_back(own);
  }
  table.plot = plot;
  return table;
}

}  // namespace choreo
