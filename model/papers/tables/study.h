#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// One way to dance: films of it, or pictures, a file a clip, whose stem is the clip's name.
struct StudyMethod {
  std::string name;
  std::filesystem::path folder;
};

/// FOLDER + `end`, what stands beside a study's folder.
std::filesystem::path BesideStudy(std::filesystem::path folder, const char* end);
/// Throws Error(kFailedPrecondition) for a study's folder that exists.
void CheckStudyFolder(const std::filesystem::path& folder);

/// A user study as in paper F's Table 3: people see the dances of several methods to one song side
/// by side, not knowing whose they are, and rank them. Writes `folder`/index.html, a page that asks
/// and saves answers, with the films of all clips that every method has under blind names, in an
/// order drawn from `seed`; and beside the folder, FOLDER.key.json, which says whose they are: the
/// folder is what people get. Throws Error(kInvalidArgument) naming what is missing, and
/// Error(kFailedPrecondition) for a folder that exists.
void WriteStudy(std::span<const StudyMethod> methods, const std::string& question, uint64_t seed,
                const std::filesystem::path& folder);

/// What people answered: a row a method, its mean rank (1 is best) and how often it came first,
/// with 95 % intervals over people, or over clips where one alone answered. `answers`: files that
/// the page has saved. Throws Error(kInvalidArgument) naming a file that is no answer to the study
/// of `key`, or is given twice.
Table ScoreStudy(const std::filesystem::path& key, std::span<const std::filesystem::path> answers);

}  // namespace choreo
