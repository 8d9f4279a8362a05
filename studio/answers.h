#pragma once

#include <memory>
#include <vector>

#include "studio/house.h"

/// What a page asks for and is answered at once: pure but for the server and files on the way. The
/// page's names for files stand in errors. `music`: what is danced to; null: nothing. Throw Error.
namespace choreo::studio {

std::shared_ptr<const Song> HearSongOf(const House& house, const File& file);
/// Each part of the answer, in order.
std::vector<Response> MakeTransition(const House& house, const Song* music,
                                     const v1::GenerateTransitionRequest& asked);
Response ComposeKeys(const House& house, const Song* music, const Compose& request);
Response WriteClip(const House& house, const Export& request);
Response ReadClip(const House& house, const File& file);
Response MakePhotoPose(const House& house, const File& landmarks);
Response ReadKeys(const House& house, const File& file);

}  // namespace choreo::studio
