// What the command can do: one file a verb.
#pragma once

#include <span>
#include <string>
#include <vector>

struct Verb {
    const char* name;
    const char* summary;
    int (*run)(const std::vector<std::string>& arguments);
};

int run_new(const std::vector<std::string>& arguments);
int run_import(const std::vector<std::string>& arguments);
int run_render(const std::vector<std::string>& arguments);
int run_animate(const std::vector<std::string>& arguments);
int run_assemble(const std::vector<std::string>& arguments);
int run_submit(const std::vector<std::string>& arguments);
int run_status(const std::vector<std::string>& arguments);
int run_check(const std::vector<std::string>& arguments);
int run_edit(const std::vector<std::string>& arguments);
int run_explain(const std::vector<std::string>& arguments);
int run_generate(const std::vector<std::string>& arguments);
int run_compare(const std::vector<std::string>& arguments);
int run_verify(const std::vector<std::string>& arguments);
int run_view(const std::vector<std::string>& arguments);
int run_bench(const std::vector<std::string>& arguments);
int run_diff(const std::vector<std::string>& arguments);
int run_plot(const std::vector<std::string>& arguments);
int run_list(const std::vector<std::string>& arguments);
int run_describe(const std::vector<std::string>& arguments);
int run_exercise(const std::vector<std::string>& arguments);
int run_plugin(const std::vector<std::string>& arguments);
int run_schema(const std::vector<std::string>& arguments);

std::span<const Verb> verbs();

/// Whether a shell asks for the name of one of `verbs`, of which all that is typed is in `arguments`: prints
/// those it may become.
bool complete_verb(const std::vector<std::string>& arguments, std::span<const Verb> verbs);
