#pragma once

#include <filesystem>
#include <vector>

#include "client/choreo_client.h"

namespace choreo {

/// A click every half second (120 a minute) over a soft tone: mono, 22 050 Hz.
std::vector<float> Clicks(double seconds);

/// The same as a 16-bit WAV file.
void WriteClicks(const std::filesystem::path& path, double seconds);

/// The same as the client takes it.
client::Audio ClicksAudio(double seconds);

}  // namespace choreo
