// Sanitizers: which one this program was built with, and what it changes for a test.
#pragma once

/// Whether this build reserves terabytes of address space, so that a test cannot limit it.
inline constexpr bool k_has_shadow_memory =
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    true;
#else
    false;
#endif
