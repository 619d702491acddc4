module;

#include "candela/api.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

export module candela.text;

export namespace candela {

/// As much of a user's text as fits a message, on one line.
CANDELA_API std::string shortened(std::string_view text);

/// The candidate that `name` was most likely meant to be, if one is close enough: at most a third of its
/// letters wrong, with a swap of neighbours counted once (Damerau 1964).
CANDELA_API std::optional<std::string> closest(std::string_view name,
                                               std::span<const std::string> candidates);

/// "12.9 GB", in powers of ten.
CANDELA_API std::string size_text(std::uint64_t bytes);

}  // namespace candela
