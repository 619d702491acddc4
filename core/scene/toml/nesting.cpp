// Determines how deeply a text nests and how much it contains, before a parser, and everything that walks its
// tree, recurses into it.
module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

module candela.scene;

import :text;

namespace candela {

namespace {

/// Far more than any scene has: object.material.kd has three parts, and its value is one list deep.
constexpr int k_most_parts = 32;
constexpr int k_most_brackets = 32;

/// Walks through a text, skipping strings and comments. In invalid TOML it may mistake something for a
/// string, but only after the position where the parser stops.
class Scan {
  public:
    Scan(std::string_view text, std::size_t& values_left) : text_(text), values_left_(values_left) {}

    std::optional<Excess> run() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == ',' || c == '=' || c == '[' || c == '{') {
                if (values_left_ == 0) {
                    return Excess{at_, fmt::format("here the scene has more than {} values",
                                                   ReadingLimits::k_most_values)};
                }
                --values_left_;
            }
            switch (c) {
                case '#':
                    at_ = std::min(text_.find('\n', at_), text_.size());
                    continue;
                case '"':
                case '\'':
                    skip_string(c);
                    continue;
                case '[':
                case '{':
                    parts_ = 1;
                    if (++brackets_ > k_most_brackets) {
                        return Excess{at_, fmt::format("this is nested more than {} deep", k_most_brackets)};
                    }
                    break;
                case ']':
                case '}':
                    parts_ = 1;
                    if (brackets_ > 0) --brackets_;
                    break;
                case '.':
                    if (++parts_ > k_most_parts) {
                        return Excess{at_, fmt::format("this key has more than {} parts", k_most_parts)};
                    }
                    break;
                case '\n':
                case '=':
                case ',':
                    parts_ = 1;
                    break;
                default:
                    break;
            }
            ++at_;
        }
        return std::nullopt;
    }

  private:
    void advance(std::size_t count) { at_ = std::min(at_ + count, text_.size()); }

    /// "…", '…', """…""" and '''…'''; only the first and third have escapes.
    void skip_string(char quote) {
        const std::string_view three = text_.substr(at_, 3);
        const bool many_lines = three == std::string(3, quote);
        advance(many_lines ? 3 : 1);
        while (at_ < text_.size()) {
            if (text_[at_] == '\\' && quote == '"') {
                advance(2);
            } else if (many_lines && text_.substr(at_, 3) == three) {
                // Up to two more quotes belong to the text.
                while (at_ < text_.size() && text_[at_] == quote) ++at_;
                return;
            } else if (!many_lines && (text_[at_] == quote || text_[at_] == '\n')) {
                if (text_[at_] == quote) ++at_;
                return;
            } else {
                ++at_;
            }
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t& values_left_;
    int brackets_ = 0;
    int parts_ = 1;  // of the key or value being read
};

}  // namespace

std::optional<Excess> first_excess(std::string_view text, std::size_t& values_left) {
    return Scan(text, values_left).run();
}

}  // namespace candela
