// Visibility of what libcandela_core.so exports. A macro, because macros do not cross modules.
#pragma once

#if __cplusplus < 202002L
#error "Candela's headers are C++20: compile with -std=c++20 or newer"
#endif

#define CANDELA_API __attribute__((visibility("default")))
