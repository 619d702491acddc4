#include "submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "import/import.h"
#include "picture_format.h"
#include "shell_words.h"
#include "task_journal.h"

import candela.text;

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

Words common_words(const CommandLine& line, const char* verb, bool has_asked) {
    Words words = {std::filesystem::canonical("/proc/self/exe").string(), verb};
    for (const std::string& word : scene_words_from(line)) words.push_back(word);
    for (const std::string& word : format_words_from(line)) words.push_back(word);
    if (has_asked) words.emplace_back("--defaults");
    words.emplace_back("--quiet");
    return words;
}

Words as_task(Words command, const JobFolder& folder, const std::string& task) {
    command.insert(command.begin() + 1, {k_task, folder.journal_of(task).string()});
    return command;
}

candela::SceneRequest repeatable_request_from(const CommandLine& line, candela::Registry& registry,
                                              bool& has_asked, Models models) {
    candela::SceneRequest request = scene_request_from(line, registry, models);
    const bool are_models = std::ranges::all_of(
        request.streams, [](const auto& stream) { return importing::is_model(stream.first); });
    if (!are_models) {
        throw candela::Error(
            candela::ErrorCategory::bad_request,
            "every task reads the scene again, which is impossible from standard input or a pipe; "
            "write it to a file");
    }
    if (request.ask) {
        request.ask = [&has_asked, ask = request.ask](const std::string& question) {
            return has_asked = ask(question);
        };
    }
    return request;
}
