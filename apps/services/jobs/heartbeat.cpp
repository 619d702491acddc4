#include "jobs/heartbeat.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

#include "console/reporting.h"
#include "files/output_folder.h"
#include "files/owned_files.h"
#include "jobs/plan.h"
#include "json/json.h"

import candela.util;

namespace fs = std::filesystem;
using std::chrono::seconds;

namespace {

constexpr std::size_t k_longest_journal = 1'000'000;  // bytes

constexpr seconds k_between_signs_of_life{5}, k_longest_silence{60};
constexpr std::size_t k_largest_journal = std::size_t{1} << 20, k_longest_failure = std::size_t{1} << 16;

std::string host_name() {
    std::array<char, 256> name{};
    static_cast<void>(::gethostname(name.data(), name.size() - 1));
    return name.data();
}

/// The scope of process numbers: a machine, its current boot, and a PID namespace.
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

/// When the file was last modified.
std::optional<double> last_sign_of_life(const fs::path& file) {
    struct stat status{};
    if (::lstat(file.c_str(), &status) != 0) return std::nullopt;
    return seconds_since_1970(status.st_mtim);
}

std::string as_date(double time) {
    constexpr double k_end_of_9999 = 253402300799.0;  // files may be dated later
    return date_text(static_cast<std::time_t>(std::clamp(time, 0.0, k_end_of_9999)));
}

/// When a process was started, in the kernel's clock ticks; nothing if it does not exist or is a zombie.
std::optional<std::int64_t> start_of(std::int64_t process) {
    const auto text = candela::read_text_file(fmt::format("/proc/{}/stat", process));
    // "7 (a name) S 1 ...": the name may contain anything.
    const std::size_t name_end = text ? text->rfind(')') : std::string::npos;
    if (name_end == std::string::npos) return std::nullopt;
    std::string_view rest = std::string_view(*text).substr(name_end + 1);
    constexpr int k_state = 1, k_start = 20;
    for (int field = 1; field <= k_start; ++field) {
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
        if (field == k_state && (rest.starts_with('Z') || rest.starts_with('X'))) return std::nullopt;
        if (field < k_start) rest.remove_prefix(std::min(rest.find(' '), rest.size()));
    }
    std::int64_t ticks = 0;
    const auto [end, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), ticks);
    return problem == std::errc() ? std::optional(ticks) : std::nullopt;
}

/// Whether the process of a journal may still exist: the same process, not another with a reused number.
/// Processes of other machines are unknowable from here.
bool may_be_there(const Json& entry) {
    if (entry.value("machine", "") != where_processes_are()) return true;
    const auto number = entry.find("pid");
    constexpr std::int64_t k_largest_number = 1 << 22;
    if (number == entry.end() || !number->is_number_integer()) return false;
    const auto process = number->get<std::int64_t>();
    if (process < 1 || process > k_largest_number) return false;
    const auto start = start_of(process);
    const auto known = entry.find("process_start");
    // If /proc hides other users' processes, this still shows that the process exists.
    if (!start) return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == EPERM;
    return known == entry.end() || *known == *start;
}

void write(const fs::path& file, const Json& entry) {
    // A plugin's message may be in any encoding.
    write_owned_file(file, json_text(entry, 2) + '\n');
}

/// As much of an error message as a journal has room for.
std::string bounded(const std::string& why) {
    return why.size() <= k_longest_failure ? why : why.substr(0, k_longest_failure) + " ...";
}

/// The folder of a journal: a job's, whose parts must not be links, or one that the user named.
void make_folder_of_journal(const fs::path& file) {
    const fs::path folder = folder_of(file), jobs = folder.parent_path();
    if (jobs.filename() == "jobs" && jobs.parent_path().filename() == ".candela")
        JobFolder(folder).make();
    else
        make_folder(folder);
}

void require_no_other_file(const fs::path& file) {
    std::error_code problem;
    if (!fs::exists(fs::symlink_status(file, problem))) return;
    const auto text = candela::read_text_file(file, k_longest_journal);
    const Json entry = text ? json_or_discarded(*text) : Json();
    if (entry.is_object() && entry.contains("state")) return;
    throw candela::Error(candela::ErrorCategory::bad_request,
                         fmt::format("'{}' is not the journal of a task; not overwriting it", file.string()));
}

/// Records that a process is working on a task.
class Journal {
  public:
    explicit Journal(const fs::path& file) : file_(file) {
        make_folder_of_journal(file_);
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
        failure["why"] = bounded(why);
        write(file_, failure);
    }

  private:
    Json entry(const char* state) const {
        return {{"state", state},
                {"host", host_name()},
                {"pid", ::getpid()},
                {"process_start", start_of(::getpid()).value_or(0)},
                {"machine", where_processes_are()},
                {"began", as_date(began_)},
                {"began_seconds", began_},
                {"seconds", now() - began_}};
    }

    void show_life() {
        std::unique_lock lock(mutex_);
        while (!end_.wait_for(lock, k_between_signs_of_life, [&] { return has_ended_; })) {
            // Both times become now, by the clock of the file's server.
            static_cast<void>(::utimensat(AT_FDCWD, file_.c_str(), nullptr, AT_SYMLINK_NOFOLLOW));
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

std::string date_text(std::time_t time) {
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    std::array<char, 32> text{};
    return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

std::optional<JournalEntry> read_journal(const fs::path& file) {
    const auto text = read_owned_file(file, k_largest_journal);
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
        if (state != "running") return std::nullopt;
        const double last = last_sign_of_life(file).value_or(0.0);
        const double began = entry.value("began_seconds", last);
        result.seconds = last - began;
        // Clocks of machines differ by seconds, but a running task cannot have started, or been alive, in the
        // future.
        const auto patience = static_cast<double>(k_longest_silence.count());
        const double silence = now() - last;
        if (silence < -patience || began > last + patience) {
            result.state = JournalEntry::State::lost;
            result.why = fmt::format(
                "its journal has times in the future: it began at {}, and its last sign of life "
                "was at {}; is the clock of {} right?",
                as_date(began), as_date(last), result.host);
        } else if (silence > patience || !may_be_there(entry)) {
            result.state = JournalEntry::State::lost;
            result.why =
                fmt::format("its process on {} ended without a report; its last sign of life was at {}",
                            result.host, as_date(last));
        }
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    return result;
}

void write_failure(const fs::path& file, const std::string& why) {
    const auto known = read_owned_file(file, k_largest_journal);
    Json entry = known ? json_or_discarded(*known) : Json::object();
    if (!entry.is_object()) entry = Json::object();
    entry["state"] = "failed";
    entry["why"] = bounded(why);
    write(file, entry);
}

int with_journal(const fs::path& file, const std::function<int()>& work) {
    require_no_other_file(file);
    const Journal journal(file);
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
