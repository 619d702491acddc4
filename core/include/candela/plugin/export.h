// Visibility of what libcandela_core.so exports: a macro, because modules do not export macros.
#pragma once

#if __cplusplus < 202002L
#error "Candela's headers are C++20: compile with -std=c++20 or newer"
#endif

#define CANDELA_EXPORT __attribute__((visibility("default")))
