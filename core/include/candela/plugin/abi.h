// The ABI that the host and a plugin must agree on, as one line of text compiled into both: everything that
// changes the layout of what crosses the boundary, or how it is called. The compiler need not match: g++ and
// clang follow the same Itanium C++ ABI.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

// Raised whenever an interface class, a struct that crosses the boundary, or the descriptor changes.
#define CANDELA_INTERFACE_VERSION 3

#define CANDELA_ABI_TEXT(x) CANDELA_ABI_TEXT_(x)
#define CANDELA_ABI_TEXT_(x) #x

// Values below 1002 are the ABIs of g++ 3.3 and older.
#if defined(__GXX_ABI_VERSION) && __GXX_ABI_VERSION >= 1002
#define CANDELA_ABI_CXX "itanium c++ abi"
#else
#define CANDELA_ABI_CXX "other c++ abi"
#endif

#if defined(_LIBCPP_VERSION)
#define CANDELA_ABI_LIBRARY "libc++ abi " CANDELA_ABI_TEXT(_LIBCPP_ABI_VERSION)
#elif defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
#define CANDELA_ABI_LIBRARY "libstdc++ cxx11"
#else
#define CANDELA_ABI_LIBRARY "libstdc++ old"
#endif
// Makes the library's containers larger.
#if defined(_GLIBCXX_DEBUG)
#define CANDELA_ABI_DEBUG " debug"
#else
#define CANDELA_ABI_DEBUG ""
#endif

// The host queries the class of an instance, and exceptions of either side may cross the boundary.
#if defined(__cpp_rtti)
#define CANDELA_ABI_RTTI "rtti"
#else
#define CANDELA_ABI_RTTI "no rtti"
#endif
#if defined(__cpp_exceptions)
#define CANDELA_ABI_EXCEPTIONS "exceptions"
#else
#define CANDELA_ABI_EXCEPTIONS "no exceptions"
#endif

namespace candela::abi {

/// Has no underlying type: its size depends on compiler switches.
enum PlainEnum { plain_enum };

using Text = std::array<char, 160>;

/// Appends to `before` the sizes that switches such as -fpack-struct and -fshort-enums change, and a null.
constexpr Text with_sizes(std::string_view before) {
    Text text{};
    std::size_t end = 0;
    const auto add = [&](std::string_view part) {
        for (const char c : part) text[end++] = c;
    };
    const auto add_number = [&](std::size_t number) {
        std::size_t power = 1;
        while (number / power >= 10) power *= 10;
        for (; power > 0; power /= 10) text[end++] = static_cast<char>('0' + number / power % 10);
    };
    add(before);
    add("; descriptor ");
    add_number(sizeof(PluginDescriptor));
    add("; enum ");
    add_number(sizeof(PlainEnum));
    return text;
}

}  // namespace candela::abi

/// The fingerprint, as a `const char*`.
#define CANDELA_ABI                                                                                        \
    ([]() -> const char* {                                                                                 \
        static constexpr candela::abi::Text text =                                                         \
            candela::abi::with_sizes("candela interface " CANDELA_ABI_TEXT(                                \
                CANDELA_INTERFACE_VERSION) "; " CANDELA_ABI_CXX "; " CANDELA_ABI_LIBRARY CANDELA_ABI_DEBUG \
                                           "; " CANDELA_ABI_RTTI "; " CANDELA_ABI_EXCEPTIONS);             \
        return text.data();                                                                                \
    }())
