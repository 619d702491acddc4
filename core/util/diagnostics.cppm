// Errors as data: problems at a position in a file, and failures.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

export module candela.util:diagnostics;

export namespace candela {

/// Why an operation failed.
enum class ErrorCategory : int {
    failure,        // at run time: input and output, memory, plugins
    bad_request,    // the request names something that does not exist, or cannot be fulfilled
    invalid_scene,  // the scene is wrong
};

/// Where to read on, or what else to try, as data: only the program knows how it offers that (a verb, a flag,
/// a page).
struct Help {
    enum class Topic : int {
        none,
        plugin,              // the manual of the plugin `subject`, such as "light/point"
        plugins_of_kind,     // the installed plugins of the kind `subject`
        all_plugins,         // everything that is installed
        default_models,      // `subject`: the models that are used with the user's consent
        plugin_trust,        // how to use plugins that other users can modify
        plugin_conformance,  // how to find out what is wrong with a plugin
    };
    Topic topic = Topic::none;
    std::string subject{};

    friend bool operator==(const Help&, const Help&) = default;
};

/// A failure that ends the requested operation. `what()` is one plain sentence for the user.
class CANDELA_EXPORT Error : public std::runtime_error {
  public:
    Error(ErrorCategory category, const std::string& message, Help help = {});
    ~Error() override;
    ErrorCategory category() const noexcept { return category_; }
    const Help& help() const noexcept { return help_; }

  private:
    ErrorCategory category_;
    Help help_;
};

enum class Severity : int { warning, error };

/// Lines and columns count from 1; line 0 means the file as a whole.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 0;  // characters to underline; 0: unknown

    friend bool operator==(const SourceLocation&, const SourceLocation&) = default;
};

struct Diagnostic {
    Severity severity = Severity::error;
    SourceLocation place;
    std::string message;
    std::string hint;  // what to do about it; may be empty
    Help help{};
};

/// All problems found in one run. Not thread-safe.
class CANDELA_EXPORT Diagnostics {
  public:
    /// The scene is wrong.
    void error(SourceLocation place, std::string message, std::string hint = {}, Help help = {});
    /// Something that the scene needs fails: an unreadable file, a plugin. Counts as an error.
    void failure(SourceLocation place, std::string message, std::string hint = {}, Help help = {});
    void warning(SourceLocation place, std::string message, std::string hint = {}, Help help = {});

    /// Keeps a file's text, so that the offending line can be shown.
    void remember_source(const std::string& file, std::string text);

    bool has_errors() const noexcept { return errors_ > 0; }
    std::size_t error_count() const noexcept { return errors_; }
    /// `invalid_scene` if any error is the scene's fault, otherwise `failure`; nothing without errors.
    std::optional<ErrorCategory> worst() const noexcept { return worst_; }
    /// Sorted by file (in the order in which the files were read), line and column.
    std::vector<Diagnostic> sorted() const;
    /// Line `place.line` of a remembered file, if it has one.
    std::optional<std::string> source_line(const SourceLocation& place) const;

  private:
    /// A file's text, and the offset of every so many lines, so that no line has to be searched for from the
    /// beginning.
    struct Source {
        std::string text;
        std::vector<std::size_t> milestones;
    };

    std::vector<Diagnostic> all_;
    std::vector<std::string> files_;  // in reading order
    std::map<std::string, Source, std::less<>> sources_;
    std::optional<ErrorCategory> worst_;
    std::size_t errors_ = 0;
};

}  // namespace candela
