#include "scene_export/system_programs.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "process/process.h"

import candela.api;

namespace candela {

bool SystemPrograms::has(const char* program) { return program_called(program).has_value(); }

ProgramResult SystemPrograms::run(std::span<const char* const> words) {
    ProgramOutput output = run_program({words.begin(), words.end()});
    out_ = std::move(output.out);
    err_ = std::move(output.err);
    return {.exit_code = output.exit_code, .out = out_.c_str(), .err = err_.c_str()};
}

int SystemPrograms::show(std::span<const char* const> words) {
    return show_program({words.begin(), words.end()});
}

}  // namespace candela
