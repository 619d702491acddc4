#include "commands/submission/job_submission.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include "cli/output_format.h"
#include "import/import.h"
#include "jobs/heartbeat.h"
#include "programs/sibling_program.h"

Words common_words(const CommandLine& line, const char* verb, bool has_asked) {
    Words words = {beside_command("bin/candela").string(), verb};
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
