#include "bash_line.h"

#include <cstddef>
#include <utility>

#include "shell_words.h"

namespace {

constexpr std::string_view k_special_in_double_quotes = "$`\"\\";

/// Readline closes the quotation marks behind a whole word, but not where the last character is one: it takes
/// them for closed then.
std::string closed(std::string text, char quote) {
    if (text.ends_with(quote)) text += quote;
    return text;
}

/// Behind an opening one.
std::string in_single_quotes(std::string_view word) {
    std::string result;
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return closed(std::move(result), '\'');
}

std::string in_double_quotes(std::string_view word) {
    std::string result;
    for (const char c : word) {
        if (c == '!') {
            // It recalls an earlier command within them, too, and a backslash before it would stay.
            result += "\"'!'\"";
            continue;
        }
        if (k_special_in_double_quotes.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return closed(std::move(result), '"');
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
    /// Whether the shell makes something else of the last word.
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
        if (c == '\n') return;  // a line that goes on
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

std::optional<std::string> BashLine::replacement_for(std::string_view word) const {
    if (!kept_ || !word.starts_with(*kept_)) return std::nullopt;
    word.remove_prefix(kept_->size());
    switch (quotes_) {
        case Quotes::none:
            return quoted_for_bash(word);
        case Quotes::single:
            return in_single_quotes(word);
        case Quotes::twofold:
            return in_double_quotes(word);
        case Quotes::ansi:
            break;
    }
    return std::nullopt;
}
