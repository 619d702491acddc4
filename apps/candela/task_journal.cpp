#include "task_journal.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <ctime>
#include <mutex>
#include <system_error>
#include <thread>

#include "json/json.h"
#include "output_folder.h"
#include "reporting.h"

import candela.diagnostics;
import candela.files;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using std::chrono::seconds;

namespace {

constexpr seconds k_between_signs_of_life{5}, k_longest_silence{60};

std::string host_name() {
    std::array<char, 256> name{};
    static_cast<void>(::gethostname(name.data(), name.size() - 1));
    return name.data();
}

/// Where a process number means something: a machine, since it was started, and a namespace of it.
std::string where_processes_are() {
    std::error_code problem;
    const std::string boot =
        candela::read_text_file("/proc/sys/kernel/random/boot_id").value_or("").substr(0, 36);
    return fmt::format("{} {}", boot, fs::read_symlink("/proc/self/ns/pid", problem).string());
}

double seconds_since_1970(const timespec& time) {
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double now() {
    timespec time{};
    ::clock_gettime(CLOCK_REALTIME, &time);
    return seconds_since_1970(time);
}

/// When the file was last touched.
std::optional<double> last_sign_of_life(const fs::path& file) {
    struct stat status{};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return seconds_since_1970(status.st_mtim);
}

std::string as_date(double time) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(time)));
}

bool is_there(const Json& entry) {
    if (entry.value("machine", "") != where_processes_are()) return true;  // cannot be known from here
    return ::kill(entry.value("pid", 0), 0) == 0 || errno == EPERM;
}

void write(const fs::path& file, const Json& entry) {
    // What a plugin says may be in any encoding.
    candela::write_text_file(file, json_text(entry, 2) + '\n');
}

/// A process says that it works on a task.
class Journal {
  public:
    explicit Journal(const fs::path& file) : file_(file) {
        make_folder(folder_of(file_));
        write(file_, entry("running"));
        alive_ = std::thread([this] { show_life(); });
    }
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;
    ~Journal() {
        {
            const std::scoped_lock lock(mutex_);
            has_ended_ = true;
        }
        end_.notify_all();
        alive_.join();
    }

    void done() const { write(file_, entry("done")); }
    void failed(int exit_code, const std::string& why) const {
        Json failure = entry("failed");
        failure["exit_code"] = exit_code;
        failure["why"] = why;
        write(file_, failure);
    }

  private:
    Json entry(const char* state) const {
        return {{"state", state},           {"host", host_name()},
                {"pid", ::getpid()},        {"machine", where_processes_are()},
                {"began", as_date(began_)}, {"began_seconds", began_},
                {"seconds", now() - began_}};
    }

    void show_life() {
        std::unique_lock lock(mutex_);
        while (!end_.wait_for(lock, k_between_signs_of_life, [&] { return has_ended_; })) {
            // Both times now, by the clock of the file's server.
            static_cast<void>(::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0));
        }
    }

    fs::path file_;
    double began_ = now();
    std::mutex mutex_;
    std::condition_variable end_;
    bool has_ended_ = false;
    std::thread alive_;
};

}  // namespace

std::optional<JournalEntry> read_journal(const fs::path& file) {
    const auto text = candela::read_text_file(file);
    if (!text) return std::nullopt;
    const Json entry = json_or_discarded(*text);
    if (!entry.is_object()) return std::nullopt;
    JournalEntry result;
    try {
        const std::string state = entry.value("state", "");
        result.host = entry.value("host", "");
        result.began = entry.value("began", "");
        result.seconds = entry.value("seconds", 0.0);
        result.why = entry.value("why", "");
        if (state == "done" || state == "failed") {
            result.state = state == "done" ? JournalEntry::State::done : JournalEntry::State::failed;
            return result;
        }
        const double last = last_sign_of_life(file).value_or(0.0);
        result.seconds = last - entry.value("began_seconds", last);
        const double silence = now() - last;
        if (!is_there(entry) || silence > static_cast<double>(k_longest_silence.count())) {
            result.state = JournalEntry::State::lost;
            result.why =
                fmt::format("its process on {} ended without a word; its last sign of life was at {}",
                            result.host, as_date(last));
        }
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    return result;
}

void write_failure(const fs::path& file, const std::string& why) {
    const auto known = candela::read_text_file(file);
    Json entry = known ? json_or_discarded(*known) : Json::object();
    if (!entry.is_object()) entry = Json::object();
    entry["state"] = "failed";
    entry["why"] = why;
    write(file, entry);
}

void add_journal_option(CommandLine& line) {
    line.options()(
        "journal", po::value<std::string>()->value_name("FILE"),
        "keep a file that says that this runs, and in the end how it went; candela status reads it");
}

int with_journal(const CommandLine& line, const std::function<int()>& work) {
    if (!line.has("journal")) return work();
    const Journal journal(line.get<std::string>("journal"));
    try {
        const int code = work();
        if (code == 0) {
            journal.done();
        } else {
            journal.failed(code, errors_reported());
        }
        return code;
    } catch (...) {
        const Failure failure = current_failure();
        journal.failed(static_cast<int>(failure.code), failure.message);
        throw;
    }
}
