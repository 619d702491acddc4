// Which frames of a film are wanted, and what their files are called.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A file name with a place for a frame's number, such as frames/%04d.png.
class FramePattern {
  public:
    /// Throws candela::Error (bad_request) unless there is exactly one place, in the file's name.
    explicit FramePattern(const std::string& pattern);

    std::filesystem::path file_of(int frame) const;
    /// As it was given.
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    std::string before_, after_;
    int digits_ = 0;  // at least
};

/// Text in which no percent sign has a meaning any more, for a pattern of printf's kind.
std::string escaped_for_pattern(const std::string& text);

/// The frames that "10..200" or "10" names, or all of them; every `step`-th. Throws candela::Error
/// (bad_request) for what is no range, and for frames that there are not.
std::vector<int> frames_from(const std::optional<std::string>& range, int step, int count);
