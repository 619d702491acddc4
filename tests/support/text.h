// Checks and changes of texts.
#pragma once

#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <exception>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// Whether a text has a part; where a check fails, Catch2 shows the text.
class Held {
  public:
    Held(std::string text, const std::string& part)
        : text_(std::move(text)), has_part_(text_.find(part) != std::string::npos) {}
    operator bool() const { return has_part_; }
    friend std::ostream& operator<<(std::ostream& out, const Held& held) { return out << held.text_; }

  private:
    std::string text_;
    bool has_part_;
};

inline Held holds(const std::string& text, const std::string& part) { return {text, part}; }

/// How often `part` occurs in a text, without overlaps.
inline std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
    return count;
}

/// The message of the exception that an action throws; empty if it throws none.
template <class Exception = std::exception, class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Exception& problem) {
        return problem.what();
    }
    return "";
}

/// The text with the first `from` replaced, which it must contain.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    INFO(from);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}
