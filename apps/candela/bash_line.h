// A command line that is being typed in bash, up to the cursor.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Readline replaces a part of the line, which begins behind the last quotation mark or character such as '='
/// and ends at the cursor, by what a completion function says, as it is: so that has to be quoted for where
/// it stands.
class BashLine {
  public:
    /// `replaced`: the part of the line that is replaced, which is its end.
    BashLine(std::string_view line, std::string_view replaced);

    /// The words as a program is given them, without expansions; the last one is the one that is being typed,
    /// and may be empty.
    const std::vector<std::string>& words() const { return words_; }

    /// What has to stand in place of the replaced part for the last word to become each of `words`. Without
    /// those that it cannot become: what stands before it is something else, or is expanded by the shell. Of
    /// several, readline inserts what they have in common, so that none shares half of an escaped character.
    std::vector<std::string> replacements_for(std::vector<std::string> words) const;

  private:
    enum class Quotes { none, single, twofold, ansi };
    class Reader;

    std::string quoted(std::string_view part) const;
    std::string quoted_otherwise(std::string_view part, std::size_t at) const;
    std::string closed(std::string text) const;

    std::vector<std::string> words_;
    Quotes quotes_ = Quotes::none;     // where the replaced part begins
    std::optional<std::string> kept_;  // of the last word, before that; nothing if the shell expands it
};
