#include "cli/signals.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

#include "console/terminal.h"
#include "sandbox/process_tree.h"
#include "sandbox/temporary_folder.h"

import candela.util;

namespace {

/// A pipe may lose its reader: `candela verify scene.toml 2>&1 | head -1`.
constexpr std::initializer_list<int> k_ending{SIGINT, SIGTERM, SIGHUP, SIGPIPE};

/// Async-signal-safe. Runs on the main thread, which therefore neither reports that a child was killed nor
/// starts the next one.
void leave_nothing_behind(int signal) {
    const pid_t process = ::getpid();
    if (::gettid() != process) {
        ::tgkill(process, process, signal);
        return;
    }
    if (are_descendants_ended_on_signals()) let_descendants_end();
    // Programs write to temporary folders, so end them first.
    if (has_temporary_folders() || are_descendants_ended_on_signals()) end_descendants();
    remove_temporary_folders();
    candela::remove_unfinished_files();
    leave_line();
    struct sigaction action{};
    action.sa_handler = SIG_DFL;
    ::sigaction(signal, &action, nullptr);
    // Blocked until this returns; then it has its default effect.
    static_cast<void>(std::raise(signal));
}

}  // namespace

void prepare_for_signals() {
    for (const int signal : k_ending) {
        struct sigaction before{};
        // Keep ignoring what the caller ignores (nohup).
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
        struct sigaction action{};
        action.sa_handler = leave_nothing_behind;
        for (const int other : k_ending) ::sigaddset(&action.sa_mask, other);
        ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}
