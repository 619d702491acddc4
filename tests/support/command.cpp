#include "support/command.h"

#include <fcntl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/interfaces/catch_interfaces_capture.hpp>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

fs::path write_file(const fs::path& path, const std::string& content) {
    fs::create_directories(path.parent_path());
    std::ofstream out(path, std::ios::binary);
    if (!(out << content) || !out.flush()) throw std::runtime_error("cannot write " + path.string());
    return path;
}

fs::path scratch_directory() {
    std::string name = Catch::getResultCapture().getCurrentTestName();
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    const fs::path directory = fs::path(CANDELA_TEST_SCRATCH) / name.substr(0, 100);
    fs::remove_all(directory);
    fs::create_directories(directory);
    return directory;
}

CommandResult run_candela(const std::vector<std::string>& arguments, const CommandSetup& setup) {
    std::vector<std::string> words = {CANDELA_TEST_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_program(words, setup);
}

int exit_code_of(pid_t child) {
    int status = 0;
    if (::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for a child");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

[[noreturn]] void become(const std::vector<std::string>& words, const CommandSetup& setup) {
    if (!setup.directory.empty() && ::chdir(setup.directory.c_str()) != 0) ::_exit(126);
    for (const auto& [name, value] : setup.environment) ::setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    if (setup.prepare) setup.prepare();
    ::execvp(argv[0], argv.data());
    ::_exit(127);
}

RunningProgram::RunningProgram(const std::vector<std::string>& words, const CommandSetup& setup) {
    static int runs = 0;
    const fs::path base =
        fs::path(CANDELA_TEST_SCRATCH) / ("run-" + std::to_string(::getpid()) + "-" + std::to_string(++runs));
    fs::create_directories(base.parent_path());
    in_ = base.string() + ".in", out_ = base.string() + ".out", err_ = base.string() + ".err";
    write_file(in_, setup.input);

    child_ = ::fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ == 0) {
        const auto redirect = [](const std::string& file, int flags, int as) {
            const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0644);
            if (descriptor < 0 || ::dup2(descriptor, as) < 0) ::_exit(126);
        };
        redirect(in_, O_RDONLY, STDIN_FILENO);
        redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
        redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
        become(words, setup);
    }
}

RunningProgram::~RunningProgram() {
    if (child_ < 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    for (const std::string& file : {in_, out_, err_}) {
        std::error_code ignored;
        fs::remove(file, ignored);
    }
}

bool RunningProgram::has_ended() const {
    siginfo_t state{};
    // WNOWAIT keeps it waitable.
    return ::waitid(P_PID, static_cast<id_t>(child_), &state, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           state.si_pid == child_;
}

void RunningProgram::send(int signal) const { ::kill(child_, signal); }

CommandResult RunningProgram::wait() {
    const CommandResult result{exit_code_of(std::exchange(child_, -1)), read_file(out_), read_file(err_)};
    for (const std::string& file : {in_, out_, err_}) fs::remove(file);
    return result;
}

CommandResult run_program(const std::vector<std::string>& words, const CommandSetup& setup) {
    return RunningProgram(words, setup).wait();
}
