// The command's verbs: one file each.
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

/// If a shell asks for the name of one of `verbs`, whose typed beginning is in `arguments`, prints its
/// completions and returns true.
bool complete_verb(const std::vector<std::string>& arguments, std::span<const Verb> verbs);
