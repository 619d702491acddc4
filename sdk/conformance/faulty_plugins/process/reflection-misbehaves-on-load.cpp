// Misbehaves when loaded, in a way that the environment selects.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "faulty_reflection.h"

namespace {

const bool is_loaded = [] {
    const char* const asked_for = std::getenv("FAULTY_ON_LOAD");
    const std::string_view what = asked_for != nullptr ? asked_for : "";
    if (what == "exit") ::_exit(0);
    if (what == "sleep") {
        for (;;) ::pause();
    }
    if (what == "stop") ::raise(SIGSTOP);
    if (what == "throw") throw std::runtime_error("not today");
    if (what == "abort") std::abort();
    if (what == "crash") ::raise(SIGSEGV);
    if (what == "close") {
        for (int file = 0; file < 1024; ++file) ::close(file);
    }
    if (what == "fork" && ::fork() == 0) {
        ::setsid();
        for (;;) ::pause();
    }
    return true;
}();

class MisbehavesOnLoad final : public faulty::Matt {
    using Matt::Matt;
};
}  // namespace

FAULTY_PLUGIN(MisbehavesOnLoad)
