// What a task of a job says of itself, in a file that others read: that it runs, where, and why it failed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "command_line.h"

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

/// Adds --journal.
void add_journal_option(CommandLine& line);

/// Does a verb's work, and keeps the journal that --journal names meanwhile: its file says every few seconds
/// that the process lives, and in the end how it went. Returns and throws what `work` does.
int with_journal(const CommandLine& line, const std::function<int()>& work);
