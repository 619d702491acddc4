// Bytes as text: in pages, and in the data: URIs of glTF.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace candela::target {

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);
/// Appends the base64 to a text.
void append_base64(std::span<const std::byte> bytes, std::string& text);
/// The bytes that a base64 text encodes. Throws std::invalid_argument if it is malformed.
std::string base64_decoded(std::string_view text);

}  // namespace candela::target
