#pragma once

#include <filesystem>

namespace choreo {

/// Computes a few frames of several transitions with a checkpoint's packed flow on random inputs.
/// Writes inputs and outputs as safetensors to check other implementations (bench/peer_torch.py).
/// Names: static_condition [rows, frames, static width]; and for each frame past.N [rows, tau,
/// width], audio.N [rows, tau + 1, audio features], has_audio.N [rows], noise.N, features.N [rows,
/// width], log_likelihood.N [rows].
void WriteFlowProbe(const std::filesystem::path& checkpoint, const std::filesystem::path& out);

}  // namespace choreo
