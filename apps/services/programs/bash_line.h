// A command line being typed in bash, up to the cursor.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Readline replaces part of the line, from after the last quotation mark or character such as '=' to the
/// cursor, with the output of a completion function, verbatim. That output must therefore be quoted for its
/// place.
class BashLine {
  public:
    /// `replaced`: the part of the line that is replaced; the line ends with it.
    BashLine(std::string_view line, std::string_view replaced);

    /// The words as a program receives them, without expansions. The last one is being typed and may be
    /// empty.
    const std::vector<std::string>& words() const { return words_; }

    /// The replacements that turn the last word into each of `words`. Omits words that cannot be reached
    /// because the text before the replaced part is different or expanded by the shell. Given several,
    /// readline inserts their common prefix, so no prefix ends within an escaped character.
    std::vector<std::string> replacements_for(std::vector<std::string> words) const;

  private:
    enum class Quotes { none, single, twofold, ansi };
    class Reader;

    std::string quoted(std::string_view part) const;
    std::string quoted_otherwise(std::string_view part, std::size_t at) const;
    std::string closed(std::string text) const;

    std::vector<std::string> words_;
    Quotes quotes_ = Quotes::none;     // where the replaced part begins
    std::optional<std::string> kept_;  // the last word up to there; nothing if the shell expands it
};
