#include "programs.h"

#include <sys/wait.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/search_path.hpp>
#include <iterator>

namespace process = boost::process;

std::optional<std::string> program_called(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const auto path = process::search_path(name);
        if (!path.empty()) return path.string();
    }
    return std::nullopt;
}

ProgramOutput output_of(const std::string& program, const std::vector<std::string>& arguments) {
    process::ipstream output;
    process::child child(program, process::args(arguments),
                         process::std_in<process::null, (process::std_out & process::std_err)> output);
    const std::string text(std::istreambuf_iterator<char>(output), {});
    child.wait();
    const int status = child.native_exit_code();
    return ProgramOutput{WIFEXITED(status) ? WEXITSTATUS(status) : 126, text};
}
