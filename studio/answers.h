#pragma once

#include <memory>
#include <vector>

#include "studio/studio_context.h"

/// What a page asks for and is answered at once: pure but for the server and files on the way. The
/// page's names for files stand in errors. `music`: what is danced to; null: nothing. Throw Error.
namespace choreo::studio {

std::shared_ptr<const Song> HearSongOf(const StudioContext& context, const File& file);
/// Each part of the answer, in order.
std::vector<Response> MakeTransition(const StudioContext& context, const Song* music,
                                     const v1::GenerateTransitionRequest& asked);
Response ComposeKeys(const StudioContext& context, const Song* music, const Compose& request);
Response WriteClip(const StudioContext& context, const Export& request);
Response ReadClip(const StudioContext& context, const File& file);
Response MakePhotoPose(const StudioContext& context, const File& landmarks);
Response ReadKeys(const StudioContext& context, const File& file);

}  // namespace choreo::studio
