#pragma once

/// Whether this program is built with a sanitizer, which cannot run LibTorch and keeps freed
/// memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
