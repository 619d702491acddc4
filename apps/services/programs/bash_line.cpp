#include "programs/bash_line.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "programs/shell_words.h"

namespace {

constexpr std::string_view k_special_in_double_quotes = "$`\"\\";

/// `word` inside an opened single quote.
std::string in_single_quotes(std::string_view word) {
    std::string result;
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result;
}

std::string common_beginning(const std::vector<std::string>& words) {
    std::string common = words.front();
    for (const std::string& word : words) common.erase(std::ranges::mismatch(common, word).in1, common.end());
    return common;
}

std::string in_double_quotes(std::string_view word) {
    std::string result;
    for (const char c : word) {
        if (c == '!') {
            // Bash also expands history inside double quotes, and would keep a backslash before the '!'.
            result += "\"'!'\"";
            continue;
        }
        if (k_special_in_double_quotes.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

}  // namespace

/// Bash Reference Manual, "Quoting".
class BashLine::Reader {
  public:
    void read(char c) {
        if (is_escaped_) return read_escaped(c);
        switch (quotes_) {
            case Quotes::none:
                return read_unquoted(c);
            case Quotes::single:
                return c == '\'' ? leave() : add(c);
            case Quotes::twofold:
                return read_in_double_quotes(c);
            case Quotes::ansi:
                is_expanded_ = true;
                if (c == '\'') return leave();
                is_escaped_ = c == '\\';
                return is_escaped_ ? void() : add(c);
        }
    }

    Quotes quotes() const { return quotes_; }
    bool is_escaped() const { return is_escaped_; }
    /// Whether the shell expands the last word.
    bool is_expanded() const { return is_expanded_; }
    const std::string& word() const { return word_; }
    std::vector<std::string> words() {
        words_.push_back(word_);
        return std::move(words_);
    }

  private:
    void add(char c) {
        word_ += c;
        is_in_word_ = true;
    }
    void leave() { quotes_ = Quotes::none; }
    void enter(Quotes quotes) {
        quotes_ = quotes;
        is_in_word_ = true;
    }

    void read_escaped(char c) {
        is_escaped_ = false;
        if (c == '\n') return;  // a continued line
        const bool is_special = k_special_in_double_quotes.find(c) != std::string_view::npos;
        if (quotes_ == Quotes::twofold && !is_special) add('\\');
        add(c);
    }

    void read_unquoted(char c) {
        const bool follows_dollar = std::exchange(is_behind_dollar_, false);
        switch (c) {
            case ' ':
            case '\t':
            case '\n':
                if (is_in_word_) words_.push_back(std::exchange(word_, {}));
                is_in_word_ = is_expanded_ = false;
                return;
            case '\\':
                is_escaped_ = true;
                return;
            case '\'':
                if (follows_dollar) word_.pop_back();
                return enter(follows_dollar ? Quotes::ansi : Quotes::single);
            case '"':
                if (follows_dollar) word_.pop_back();
                return enter(Quotes::twofold);
            default:
                is_behind_dollar_ = c == '$';
                is_expanded_ = is_expanded_ || quoted_for_bash(std::string_view(&c, 1)).size() > 1;
                return add(c);
        }
    }

    void read_in_double_quotes(char c) {
        if (c == '"') return leave();
        if (c == '\\') {
            is_escaped_ = true;
            return;
        }
        is_expanded_ = is_expanded_ || c == '$' || c == '`' || c == '!';
        add(c);
    }

    std::vector<std::string> words_;
    std::string word_;
    Quotes quotes_ = Quotes::none;
    bool is_in_word_ = false, is_escaped_ = false, is_expanded_ = false, is_behind_dollar_ = false;
};

BashLine::BashLine(std::string_view line, std::string_view replaced) {
    const bool is_its_end = line.ends_with(replaced);
    const std::size_t kept = is_its_end ? line.size() - replaced.size() : line.size();
    Reader reader;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i == kept && !reader.is_escaped() && !reader.is_expanded()) {
            quotes_ = reader.quotes();
            kept_ = reader.word();
        }
        reader.read(line[i]);
    }
    if (kept == line.size() && is_its_end && !reader.is_escaped() && !reader.is_expanded()) {
        quotes_ = reader.quotes();
        kept_ = reader.word();
    }
    words_ = reader.words();
}

std::string BashLine::quoted(std::string_view part) const {
    return quotes_ == Quotes::none     ? quoted_for_bash(part)
           : quotes_ == Quotes::single ? in_single_quotes(part)
                                       : in_double_quotes(part);
}

/// Like quoted(), but puts one character in quotation marks of its own.
std::string BashLine::quoted_otherwise(std::string_view part, std::size_t at) const {
    const std::string character(1, part[at]);
    const std::string mark = character == "'" ? "\"" : "'";
    const std::string outside = quotes_ == Quotes::twofold ? "\"" : "";
    return quoted(part.substr(0, at)) + outside + mark + character + mark + outside +
           quoted(part.substr(at + 1));
}

/// Readline closes the quotation marks after a whole word, unless its last character is a quotation mark: it
/// then takes them for closed.
std::string BashLine::closed(std::string text) const {
    const char mark = quotes_ == Quotes::single ? '\'' : '"';
    if (quotes_ != Quotes::none && text.ends_with(mark)) text += mark;
    return text;
}

std::vector<std::string> BashLine::replacements_for(std::vector<std::string> words) const {
    if (!kept_ || quotes_ == Quotes::ansi) return {};
    std::erase_if(words, [&](const std::string& word) { return !word.starts_with(*kept_); });
    for (std::string& word : words) word.erase(0, kept_->size());
    std::vector<std::string> replacements;
    for (const std::string& word : words) replacements.push_back(quoted(word));
    if (words.size() > 1) {
        const std::string common = common_beginning(words), inserted = common_beginning(replacements);
        // Otherwise they differ after a backslash, which would be left without a character.
        if (inserted != quoted(common) && inserted.ends_with('\\') && words.front().size() > common.size())
            replacements.front() = quoted_otherwise(words.front(), common.size());
    }
    for (std::string& replacement : replacements) replacement = closed(std::move(replacement));
    return replacements;
}
