#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// One method's films or pictures, a file per clip, with the clip's name as its stem.
struct StudyMethod {
  std::string name;
  std::filesystem::path folder;
};

/// FOLDER + `end`: a file beside a study's folder.
std::filesystem::path BesideStudy(std::filesystem::path folder, const char* end);
/// Throws Error(kFailedPrecondition) if a study's folder exists already.
void CheckStudyFolder(const std::filesystem::path& folder);

/// Makes a user study as in paper F's Table 3: people see the dances of several methods to one song
/// side by side, blinded, and rank them. Writes `folder`/index.html, a page that asks and saves
/// answers, with the films of all clips that every method has, under blind names and in an order
/// drawn from `seed`. Give people the folder; FOLDER.key.json beside it says which film is whose.
/// Throws Error(kInvalidArgument) naming what is missing, and Error(kFailedPrecondition) for a
/// folder that exists.
void WriteStudy(std::span<const StudyMethod> methods, const std::string& question, uint64_t seed,
                const std::filesystem::path& folder);

/// Scores the answers: for each method a row with its mean rank (1 is best) and how often it came
/// first, with 95 % intervals over people, or over clips if only one person answered. `answers`:
/// files saved by the page. Throws Error(kInvalidArgument) naming a file that does not belong to
/// the study of `key` or is given twice.
Table ScoreStudy(const std::filesystem::path& key, std::span<const std::filesystem::path> answers);

}  // namespace choreo
