#include "model/papers/tables/study.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/safetensors.h"
#include "model/core/numbers/random.h"
#include "model/papers/tables/study_page.h"

namespace choreo {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kMaxMethods = 8;

/// The films of a method by clip.
std::map<std::string, std::filesystem::path> FilmsOf(const StudyMethod& method) {
  if (!std::filesystem::is_directory(method.folder))
    throw InvalidArgument("--method", method.folder.string() + " is not a folder");
  std::map<std::string, std::filesystem::path> films;
  for (const auto& entry : std::filesystem::directory_iterator(method.folder)) {
    const std::filesystem::path& path = entry.path();
    if (!IsFilm(path) && !IsPicture(path)) continue;
    if (!films.emplace(path.stem(), path).second)
      throw InvalidArgument("--method", method.folder.string() + " has two files of the clip \"" +
                                            path.stem().string() + '"');
  }
  return films;
}

/// Clips that all methods have.
std::vector<std::string> CommonClips(
    const std::vector<std::map<std::string, std::filesystem::path>>& films) {
  std::vector<std::string> clips;
  for (const auto& [clip, path] : films.front()) {
    if (std::ranges::all_of(films, [&](const auto& of) { return of.contains(clip); }))
      clips.push_back(clip);
  }
  if (clips.empty())
    throw InvalidArgument("--method", "no clip has a film (.webm, .mp4, .png, .jpg) of each");
  return clips;
}

template <typename Value>
void Shuffle(std::vector<Value>* values, Random* random) {
  for (int64_t i = std::ssize(*values); i > 1; --i)
    std::swap((*values)[i - 1], (*values)[random->Integer(0, i)]);
}

/// The letters of a clip's films, best first.
std::vector<std::string> Ranking(const std::filesystem::path& file, const Json& answer) {
  const auto ranking = answer.at("ranking").get<std::vector<std::string>>();
  if (std::set<std::string>(ranking.begin(), ranking.end()).size() != ranking.size())
    throw InvalidArgument(file.string(), "ranks a film twice");
  return ranking;
}

/// One method's results by participant (or clip): sums of ranks and of first places, and the number
/// of answers.
struct Sums {
  std::vector<double> ranks, firsts, counts;

  /// `rank`: from 0.
  void Add(size_t group, size_t rank) {
    for (std::vector<double>* list : {&ranks, &firsts, &counts})
      list->resize(std::max(list->size(), group + 1));
    ranks[group] += static_cast<double>(rank + 1);
    firsts[group] += rank == 0 ? 100 : 0;
    ++counts[group];
  }
};

}  // namespace

std::filesystem::path BesideStudy(std::filesystem::path folder, const char* end) {
  if (!folder.has_filename()) folder = folder.parent_path();
  return folder += end;
}

void CheckStudyFolder(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder))
    throw Error(ErrorCode::kFailedPrecondition, folder.string(), "is there already");
}

void WriteStudy(std::span<const StudyMethod> methods, const std::string& question, uint64_t seed,
                const std::filesystem::path& folder) {
  if (methods.size() < 2 || methods.size() > kMaxMethods)
    throw InvalidArgument("--method", "is given " + std::to_string(methods.size()) +
                                          " times, must be 2 to " + std::to_string(kMaxMethods));
  std::vector<std::map<std::string, std::filesystem::path>> films;
  std::set<std::string> names;
  for (const StudyMethod& method : methods) {
    if (!names.insert(method.name).second)
      throw InvalidArgument("--method", "two are called \"" + method.name + '"');
    films.push_back(FilmsOf(method));
  }
  std::vector<std::string> clips = CommonClips(films);
  CheckStudyFolder(folder);
  std::filesystem::create_directories(folder);

  Random random(seed);
  Shuffle(&clips, &random);
  Json whose_films = Json::array(), shown = Json::array();
  Safetensors copied;  // only for its hash, which identifies a study by its films and their names
  for (size_t clip = 0; clip < clips.size(); ++clip) {
    std::vector<size_t> order(methods.size());
    std::iota(order.begin(), order.end(), size_t{0});
    Shuffle(&order, &random);
    Json whose, seen = Json::array();
    for (size_t place = 0; place < order.size(); ++place) {
      const std::filesystem::path& film = films[order[place]].at(clips[clip]);
      const std::string letter(1, static_cast<char>('A' + place));
      const std::string name = std::to_string(clip + 1) + letter + film.extension().string();
      std::filesystem::copy_file(film, folder / name);
      copied.metadata[name] = ReadFile(film);
      whose[letter] = methods[order[place]].name;
      seen.push_back(name);
    }
    whose_films.push_back({{"clip", clips[clip]}, {"films", whose}});
    shown.push_back(seen);
  }
  const std::string study = ContentHash(copied);
  WriteFile(folder / "index.html", StudyPage(question, {{"study", study}, {"clips", shown}}));
  const Json key = {{"study", study}, {"clips", whose_films}};
  WriteFile(BesideStudy(folder, ".key.json"), key.dump(2) + '\n');
}

Table ScoreStudy(const std::filesystem::path& key, std::span<const std::filesystem::path> answers) {
  const auto parse = [](const std::filesystem::path& path) {
    const Json json = Json::parse(ReadFile(path), nullptr, /*allow_exceptions=*/false);
    if (!json.is_object() || !json.contains("study"))
      throw InvalidArgument(path.string(), "is not a file of a study");
    return json;
  };
  const Json study = parse(key);
  std::map<std::string, Sums> sums;
  std::set<std::filesystem::path> taken;
  int64_t rankings = 0;
  const bool alone = answers.size() == 1;
  for (size_t person = 0; person < answers.size(); ++person) {
    const std::filesystem::path& path = answers[person];
    if (!taken.insert(std::filesystem::weakly_canonical(path)).second)
      throw InvalidArgument(path.string(), "is given twice");
    try {
      const Json saved = parse(path);
      if (saved.at("study") != study.at("study"))
        throw InvalidArgument(path.string(), "answers another study than " + key.string());
      for (const Json& answer : saved.at("answers")) {
        const auto number = answer.at("clip").get<size_t>();
        const Json& clip = study.at("clips").at(number - 1);
        const std::vector<std::string> ranking = Ranking(path, answer);
        if (ranking.size() != clip.at("films").size())
          throw InvalidArgument(path.string(), "ranks " + std::to_string(ranking.size()) + " of " +
                                                   std::to_string(clip.at("films").size()) +
                                                   " films of clip " + std::to_string(number));
        ++rankings;
        const size_t group = alone ? number - 1 : person;
        for (size_t rank = 0; rank < ranking.size(); ++rank)
          sums[clip.at("films").at(ranking[rank])].Add(group, rank);
      }
    } catch (const nlohmann::json::exception& error) {
      throw InvalidArgument(path.string(), std::string("is not an answer: ") + error.what());
    }
  }

  Table table;
  table.name = "study";
  table.title = "What people prefer";
  table.note = std::to_string(rankings) + " rankings by " + std::to_string(answers.size()) +
               " judges. Rank 1 is the best. Intervals are over " + (alone ? "clips" : "judges") +
               ", 95 %.";
  table.label_headings = {"method"};
  const auto mean = [](const std::vector<double>& of, const std::vector<double>& counts) {
    const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
    return Cell(std::accumulate(of.begin(), of.end(), 0.0) / count, BootstrapRatio(of, counts));
  };
  for (const auto& [method, of] : sums) {
    table.AddRow({method});
    table.Put("mean rank", 2, mean(of.ranks, of.counts));
    table.Put("first %", 0, mean(of.firsts, of.counts));
  }
  std::ranges::sort(table.rows, {}, [](const TableRow& row) { return row.cells[0].value; });
  return table;
}

}  // namespace choreo
