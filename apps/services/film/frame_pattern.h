// Which frames of a film to render, and their file names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A file name with a placeholder for a frame's number, such as frames/%04d.png.
class FramePattern {
  public:
    /// Throws candela::Error (bad_request) unless there is exactly one placeholder, in the file's name.
    explicit FramePattern(const std::string& pattern);

    std::filesystem::path file_of(int frame) const;
    /// The pattern as given.
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    std::string before_, after_;
    int digits_ = 0;  // the minimum
};

/// Escapes the percent signs of a text for a printf-like pattern.
std::string escaped_for_pattern(const std::string& text);

/// The frames named by "10..200" or "10", or all of them; every `step`-th. Throws candela::Error
/// (bad_request) for an invalid range or frames out of range.
std::vector<int> frames_from(const std::optional<std::string>& range, int step, int count);
