#include "jobs/submission.h"

#include <fmt/format.h>

#include <algorithm>

#include "programs/shell_words.h"

import candela.util;

namespace {

void require_plain(const std::string& word) {
    const auto is_control = [](char c) { return (c >= 0 && c < ' ' && c != '\t') || c == '\x7f'; };
    const char* problem = nullptr;
    if (candela::first_invalid_byte(word))
        problem = "is not UTF-8, the encoding of a job's plan";
    else if (std::ranges::any_of(word, is_control))
        problem = "contains a line break or another control character, which a job's scripts cannot hold";
    if (problem != nullptr)
        throw candela::Error(
            candela::ErrorCategory::bad_request,
            fmt::format("'{}' {}; use another name or value", candela::printable(word), problem));
}

void require_plain(const Words& words) {
    for (const std::string& word : words) require_plain(word);
}

}  // namespace

void require_plain_words(const Submission& job) {
    require_plain(job.plan.directory.string());
    for (const Words& command : job.commands) require_plain(command);
    require_plain(job.last);
    require_plain(job.queue_options);
}

std::string shell_line(const Submission& job, const Words& command) {
    return fmt::format("cd {} && exec {}", quoted_for_shell(job.plan.directory.string()),
                       command_line_of(command));
}
