// Scans a text for words and numbers, counting lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mesh_io {

/// Parses a number in any of these formats' notations: a sign, digits, a point, an exponent; also `.5` and
/// `5.`. A number too small for a double becomes zero, one too large infinite. Accepts infinities and NaN as
/// C libraries print them: `inf`, `-nan(ind)`, `1.#INF`, `-1.#IND`. Returns nothing for anything else,
/// including a number with trailing characters.
std::optional<double> number_from(std::string_view word);

/// Parses an integer or a number with an integer value ("3.0"); nothing if it does not fit.
std::optional<std::int64_t> integer_from(std::string_view word);

/// Called now and then with the progress in [0, 1].
using Progress = std::function<void(double)>;

/// Reads a text word by word. Lines end with LF, CR LF or CR.
class TextScanner {
  public:
    explicit TextScanner(std::string_view text, Progress progress = {})
        : text_(text), progress_(std::move(progress)) {}

    /// The next word, on whichever line; empty at the end.
    std::string_view word() {
        while (at_ < text_.size() && is_blank(text_[at_])) skip_blank();
        return rest_of_word();
    }
    /// The next word on this line; empty at its end.
    std::string_view word_on_line() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        if (at_ < text_.size() && is_blank(text_[at_])) return {};
        return rest_of_word();
    }
    /// The rest of this line, without surrounding blanks.
    std::string_view rest_of_line() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
        return trimmed(text_.substr(begin, at_ - begin));
    }
    /// Moves to the beginning of the next line.
    void next_line() {
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
        if (at_ < text_.size()) skip_blank();
    }
    bool at_end() const { return at_ >= text_.size(); }
    std::size_t line() const { return line_; }
    std::size_t position() const { return at_; }

  private:
    static std::string_view trimmed(std::string_view text) {
        while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
        while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
        return text;
    }
    static bool is_blank(char c) {
        return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f';
    }
    void skip_blank() {
        const char c = text_[at_++];
        if (c == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
        if (c != '\n' && c != '\r') return;
        constexpr std::size_t k_lines_between = 1 << 16;
        if (++line_ % k_lines_between == 0 && progress_)
            progress_(static_cast<double>(at_) / static_cast<double>(text_.size()));
    }
    std::string_view rest_of_word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    Progress progress_;
};

/// Quotes a word for a message: cuts long words, and shows control and non-ASCII characters as '?'.
std::string in_quotes(std::string_view word);

}  // namespace mesh_io
