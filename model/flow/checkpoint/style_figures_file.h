#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "model/messages/style_figures.h"

namespace choreo {

/// Reads how often a checkpoint's styles are recognised, from its StyleFiguresFile:
///
///     {"weights": "26bf...", "styles": {"recognised": 8.4, "chance": 6.25, "low": 7.6}}
///
/// `weights` is the content hash of the measured checkpoint. Whatever is in the checkpoint itself
/// changes this hash, so figures cannot be there. None without the file. Throws Error, whose field
/// begins with the file, if it is unusable, or if `hash` is another: they are of an earlier
/// training or of another model.
std::optional<StyleFigures> ReadStyleFigures(const std::filesystem::path& checkpoint,
                                             const std::string& hash);

}  // namespace choreo
