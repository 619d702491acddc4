// In `candela`, the place of all that only candela-verbs contains.
#include "cli/elsewhere.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/model_scene.h"
#include "commands/part_rendering.h"
#include "jobs/heartbeat.h"

using Arguments = std::vector<std::string>;

int run_import(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_animate(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_submit(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_status(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_assemble(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_check(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_edit(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_explain(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_generate(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_verify(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_view(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_compare(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_bench(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_diff(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_plot(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_exercise(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_list(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_describe(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_plugin(const Arguments& /*arguments*/) { throw Elsewhere(); }
int run_schema(const Arguments& /*arguments*/) { throw Elsewhere(); }

int render_part(const CommandLine& /*line*/) { throw Elsewhere(); }

int with_journal(const std::filesystem::path& /*file*/, const std::function<int()>& /*work*/) {
    throw Elsewhere();
}

void expect_models() { throw Elsewhere(); }

const std::string& scene_of_model(const std::string& /*file*/, const ModelOptions& /*options*/,
                                  candela::Registry& /*registry*/) {
    throw Elsewhere();
}

void forget_triangles_of_models() {}
