// A folder in which a test writes files and runs the command.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"

/// A new, empty folder of the running test; it stays for inspection until the same test runs again.
class Folder {
  public:
    Folder() : path_(scratch_directory()) {}
    /// With these files: names and contents.
    Folder(std::initializer_list<std::pair<std::string, std::string>> files) : Folder() {
        for (const auto& [name, content] : files) write(name, content);
    }

    const std::filesystem::path& path() const { return path_; }
    /// A folder may stand wherever a path is expected.
    operator const std::filesystem::path&() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
    bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        return write_file(path_ / name, content);
    }
    std::string read(const std::string& name) const { return read_file(path_ / name); }

    using Environment = std::vector<std::pair<std::string, std::string>>;

    /// Runs the command in the folder, with the words of a line, which spaces separate, and with `more`.
    CommandResult run(const std::string& line, const std::vector<std::string>& more = {},
                      const Environment& environment = {}) const {
        std::istringstream in(line);
        std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
        return run_words(joined(std::move(words), more), environment);
    }
    /// The same, with words that may contain spaces.
    CommandResult run_words(const std::vector<std::string>& words,
                            const Environment& environment = {}) const {
        return run_candela(words, {.environment = environment, .directory = path_});
    }

  private:
    std::filesystem::path path_;
};
