// Messages for people: problems at a position in a file, and failures.
module;

#include "candela/api.h"

#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

export module candela.diagnostics;

export namespace candela {

/// Exit codes of the command.
enum class ExitCode : int { ok = 0, failure = 1, usage = 2, invalid_scene = 3, verification_failed = 4 };

/// A failure that ends the requested operation. `what()` is one plain sentence for a person.
class CANDELA_API Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message);
    ~Error() override;
    ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

enum class Severity : int { warning, error };

/// Lines and columns count from 1; line 0 means the file as a whole.
struct SourcePlace {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 0;  // characters to underline; 0: unknown

    friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

struct Diagnostic {
    Severity severity = Severity::error;
    SourcePlace place;
    std::string message;
    std::string hint;  // what to do about it; may be empty
};

/// Everything found in one run. Not thread-safe.
class CANDELA_API Diagnostics {
  public:
    /// The scene is wrong.
    void error(SourcePlace place, std::string message, std::string hint = {});
    /// Something that the scene needs fails: a file that cannot be read, a plugin. Counts as an error.
    void failure(SourcePlace place, std::string message, std::string hint = {});
    void warning(SourcePlace place, std::string message, std::string hint = {});

    /// Keeps a file's text, so that the offending line can be shown.
    void remember_source(const std::string& file, std::string text);

    bool has_errors() const noexcept { return errors_ > 0; }
    std::size_t error_count() const noexcept { return errors_; }
    /// `invalid_scene` if the scene is wrong; otherwise `failure` if something failed; otherwise `ok`.
    ExitCode exit_code() const noexcept { return exit_code_; }
    /// Sorted by file (in the order in which the files were read), line and column.
    std::vector<Diagnostic> sorted() const;
    /// Line `place.line` of a remembered file, if there is one.
    std::optional<std::string> source_line(const SourcePlace& place) const;

    /// The first `most` diagnostics as text, each with its line and a mark below the position, and the number
    /// of those omitted.
    std::string text(bool in_color, std::size_t most = k_most_shown) const;
    /// All diagnostics for programs: an array of objects with severity, file, line, column, length, message,
    /// hint.
    std::string json() const;

    static constexpr std::size_t k_most_shown = 50;

  private:
    std::vector<std::size_t> order_of_places() const;

    std::vector<Diagnostic> all_;
    std::vector<std::string> files_;  // in reading order
    std::map<std::string, std::string, std::less<>> sources_;
    ExitCode exit_code_ = ExitCode::ok;
    std::size_t errors_ = 0;
};

}  // namespace candela
