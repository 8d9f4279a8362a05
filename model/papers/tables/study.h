#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo {

/// One method's films or pictures: a file per clip, named after the clip.
struct StudyMethod {
  std::string name;
  std::filesystem::path folder;
};

/// The path FOLDER + `end` of a file beside a study's folder.
std::filesystem::path BesideStudy(std::filesystem::path folder, const char* end);
/// Throws Error(kFailedPrecondition) if a study's folder exists already.
void CheckStudyFolder(const std::filesystem::path& folder);

/// Makes a user study as in paper F's Table 3: participants see the dances of several methods to
/// one song side by side, blinded, and rank them. Writes `folder`/index.html, a page that asks and
/// saves answers, with the films of all clips that every method has, under blind names and in an
/// order drawn from `seed`. Give participants the folder. FOLDER.key.json beside it maps films to
/// methods. Throws Error(kInvalidArgument) naming what is missing, and Error(kFailedPrecondition)
/// for a folder that exists.
void WriteStudy(std::span<const StudyMethod> methods, const std::string& question, uint64_t seed,
                const std::filesystem::path& folder);

/// Scores the answers. Each method has a row with its mean rank (1 is best) and the share of its
/// first places, with 95 % intervals over participants, or over clips if there is only one
/// participant. `answers`: files saved by the page. Throws Error(kInvalidArgument) naming a file
/// that does not belong to the study of `key` or is given twice.
Table ScoreStudy(const std::filesystem::path& key, std::span<const std::filesystem::path> answers);

}  // namespace choreo
