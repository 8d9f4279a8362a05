#pragma once

/// Whether this program runs under a sanitizer: LibTorch can't, and freed memory is kept.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
