// What a task of a job says of itself, in a file that others read: that it runs, where, and why it failed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

/// What is known of a task that was begun.
struct JournalEntry {
    enum class State {
        running,
        lost,  // it said that it runs, and is no longer there
        failed,
        done
    };
    State state = State::running;
    std::string host;
    std::string began;   // UTC, ISO 8601
    double seconds = 0;  // that it took, or has taken until its last sign of life
    std::string why;     // of a failure
};

/// Nothing if there is no journal, or none that can be read. A process of this machine is lost if it is no
/// longer there; one of another machine if it has given no sign of life for a minute.
std::optional<JournalEntry> read_journal(const std::filesystem::path& file);

/// Writes down that a task failed whose process could not do so itself. Throws candela::Error (failure).
void write_failure(const std::filesystem::path& file, const std::string& why);

/// The first word of a task's command, which its journal and then the verb follow. Users have no such option:
/// it writes a file that is not checked against the verb's inputs.
inline constexpr const char* k_task = "--task";

/// Does a task's work, and keeps its journal meanwhile: the file says every few seconds that the process
/// lives, and in the end how it went. Returns and throws what `work` does; throws candela::Error
/// (bad_request) where the file is something else than a journal.
int with_journal(const std::filesystem::path& file, const std::function<int()>& work);
