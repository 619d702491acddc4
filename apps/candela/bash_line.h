// A command line that is being typed in bash, up to the cursor.
#pragma once

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

    /// What has to stand in place of the replaced part for the last word to become `word`. Nothing where that
    /// cannot be: what stands before it is something else, or is expanded by the shell.
    std::optional<std::string> replacement_for(std::string_view word) const;

  private:
    enum class Quotes { none, single, twofold, ansi };
    class Reader;

    std::vector<std::string> words_;
    Quotes quotes_ = Quotes::none;     // where the replaced part begins
    std::optional<std::string> kept_;  // of the last word, before that; nothing if the shell expands it
};
