#pragma once

#include <memory>

#include "studio/studio_context.h"

/// Answers the page's simple calls. Pure, except for the server and temporary files. Errors name
/// files as the page does. `music`: the dance's music, or null. All throw Error.
namespace choreo::studio {

std::shared_ptr<const Song> HearSongOf(const StudioContext& context, const File& file);
Response ComposeKeys(const StudioContext& context, const Song* music, const Compose& request);
Response WriteClip(const StudioContext& context, const Export& request);
Response ReadClip(const StudioContext& context, const File& file);
Response CheckClip(const StudioContext& context, const Clip& clip);
Response MakePhotoPose(const StudioContext& context, const File& landmarks);

}  // namespace choreo::studio
