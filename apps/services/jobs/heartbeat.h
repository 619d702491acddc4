// The journal of a job's task, for others to read: whether it runs, where, and why it failed.
#pragma once

#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

/// The known state of a task that was started.
struct JournalEntry {
    enum class State {
        running,
        lost,  // the journal says running, but the process no longer exists
        failed,
        done
    };
    State state = State::running;
    std::string host;
    std::string began;   // UTC, ISO 8601
    double seconds = 0;  // duration, or time until its last sign of life
    std::string why;     // why it failed
};

/// "2026-02-28T13:05:09Z": UTC, as in ISO 8601.
std::string date_text(std::time_t time);

/// Nothing if there is no readable journal. A process on this machine is lost if it no longer exists; one on
/// another machine, if it has given no sign of life for a minute.
std::optional<JournalEntry> read_journal(const std::filesystem::path& file);

/// Records the failure of a task whose process could not do so itself. Throws candela::Error (failure).
void write_failure(const std::filesystem::path& file, const std::string& why);

/// The first word of a task's command; its journal and then the verb follow. Not an option for users: it
/// writes a file that is not checked against the verb's inputs.
inline constexpr const char* k_task = "--task";

/// Does a task's work while keeping its journal: every few seconds the file records that the process is
/// alive, and at the end the result. Returns and throws like `work`; throws candela::Error (bad_request) if
/// the file exists and is not a journal.
int with_journal(const std::filesystem::path& file, const std::function<int()>& work);
