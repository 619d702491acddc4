module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

export module candela.util:text;

export namespace candela {

/// The beginning of a user's text, short enough for a message; not yet printable().
CANDELA_EXPORT std::string shortened(std::string_view text);

enum class LineBreaks : bool { escaped, kept };

/// Turns any bytes into text that is safe to print: valid UTF-8 without characters that control a terminal,
/// change the direction of writing, or are invisible. Those become \u{202e}, bytes that are not UTF-8 \x{9b}.
/// Tabs are kept.
CANDELA_EXPORT std::string printable(std::string_view text, LineBreaks line_breaks = LineBreaks::escaped);

/// The code point of a character that printable() escapes, tabs and line breaks included; nothing for any
/// other, and for a byte that is not UTF-8.
CANDELA_EXPORT std::optional<char32_t> hidden_code_point(std::string_view character);

/// The offset at which `text` stops being UTF-8, or nothing.
CANDELA_EXPORT std::optional<std::size_t> first_invalid_byte(std::string_view text);

/// The character at the start of `text`: all its bytes, or one byte that does not begin a UTF-8 character;
/// empty if `text` is.
CANDELA_EXPORT std::string_view first_character(std::string_view text);

/// The number of characters in `text`, counting each byte that is not UTF-8 as one.
CANDELA_EXPORT std::size_t character_count(std::string_view text);

/// The extension of a file's name, in lower case (ASCII), without its dot; may be empty.
CANDELA_EXPORT std::string extension_of(const std::filesystem::path& file);

/// "did you mean 'shininess'?", with `prefix` before the word; or empty.
CANDELA_EXPORT std::string suggestion(std::string_view name, std::span<const std::string> candidates,
                                      std::string_view prefix = {});

/// The candidate that `name` most likely stands for, if one is close enough: at most a third of its letters
/// wrong, with a swap of neighbours counted once (Damerau 1964).
CANDELA_EXPORT std::optional<std::string> closest(std::string_view name,
                                                  std::span<const std::string> candidates);

/// A value as TOML, and as JSON unless it contains a hidden character: a string in double quotes, with
/// escapes (throws Error if it is not UTF-8); a number in as few digits as read back as the same number,
/// never as an integer (throws Error if it is not finite).
CANDELA_EXPORT std::string toml_text(std::string_view text);
CANDELA_EXPORT std::string toml_text(double x);
CANDELA_EXPORT std::string toml_text(float x);
/// A key as TOML, quoted if necessary.
CANDELA_EXPORT std::string toml_key(std::string_view key);

/// "12.9 GB", in powers of ten.
CANDELA_EXPORT std::string size_text(std::uint64_t bytes);

}  // namespace candela
