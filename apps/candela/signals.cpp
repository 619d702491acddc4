#include "signals.h"

#include <csignal>
#include <initializer_list>

#include "terminal.h"

import candela.core;

namespace {

void leave_nothing_behind(int signal) {
    candela::remove_unfinished_files();
    leave_line();
    // SA_RESETHAND: this time the signal does what it always does.
    static_cast<void>(std::raise(signal));
}

}  // namespace

void prepare_for_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before{};
        // What the caller ignores (nohup) stays ignored.
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
        struct sigaction action{};
        action.sa_handler = leave_nothing_behind;
        action.sa_flags = SA_RESETHAND;
        ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}
