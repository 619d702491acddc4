// What must match between the host and a plugin, as one line of text compiled into both.
#pragma once

#include <cstddef>  // defines the standard library's own macros

// Raised whenever an interface class, a struct that crosses the boundary, or the descriptor changes.
#define CANDELA_INTERFACE_VERSION 3

#define CANDELA_ABI_TEXT(x) CANDELA_ABI_TEXT_(x)
#define CANDELA_ABI_TEXT_(x) #x

#if defined(_LIBCPP_VERSION)
#define CANDELA_ABI_LIBRARY "libc++ abi " CANDELA_ABI_TEXT(_LIBCPP_ABI_VERSION)
#elif defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
#define CANDELA_ABI_LIBRARY "libstdc++ cxx11"
#else
#define CANDELA_ABI_LIBRARY "libstdc++ old"
#endif

#define CANDELA_ABI                                                                                 \
    "candela interface " CANDELA_ABI_TEXT(CANDELA_INTERFACE_VERSION) "; c++ abi " CANDELA_ABI_TEXT( \
        __GXX_ABI_VERSION) "; " CANDELA_ABI_LIBRARY
