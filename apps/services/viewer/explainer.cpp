#include "viewer/explainer.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "json/json.h"
#include "viewer/arguments.h"

namespace {

using std::chrono::milliseconds;

// Long enough for the picture to be drawn first and for a burst of saves to be over.
constexpr milliseconds k_quiet{200};
// A scene in memory is a waste if no pixels are being explained.
constexpr std::chrono::minutes k_longest_idle{10};
constexpr std::chrono::minutes k_patience{1};

view::Outcome failed(std::string why) { return {.is_success = false, .content = std::move(why)}; }

}  // namespace

Explainer::Explainer(std::vector<std::string> arguments)
    : arguments_(std::move(arguments)), latest_(Clock::now()), thread_([this] { get_ready(); }) {}

Explainer::~Explainer() {
    {
        const std::lock_guard lock(waiting_);
        is_ending_ = true;
    }
    news_.notify_all();
    thread_.join();
}

void Explainer::scene_changed() {
    {
        const std::lock_guard lock(waiting_);
        is_outdated_ = true;
        latest_ = Clock::now();
    }
    news_.notify_all();
}

void Explainer::start(const std::vector<std::string>& options) {
    program_.reset();
    options_ = options;
    std::vector<std::string> words{"/proc/self/exe", "explain", "--quiet", "--json", "--pixel=-"};
    const std::vector<std::string> more = view::with_options(arguments_, options);
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<candela::AnsweringProgram>(words);
}

void Explainer::get_ready() {
    std::unique_lock waiting(waiting_);
    while (!is_ending_) {
        const Clock::time_point due = latest_ + (is_outdated_ ? Clock::duration(k_quiet) : k_longest_idle);
        if (Clock::now() < due) {
            news_.wait_until(waiting, due);
            continue;
        }
        const bool is_wanted = std::exchange(is_outdated_, false);
        latest_ = Clock::now();
        waiting.unlock();
        {
            const std::lock_guard lock(using_);
            try {
                if (is_wanted)
                    start(options_);
                else
                    program_.reset();
            } catch (const std::exception&) {
                program_.reset();  // the next request tries again, and gets the error
            }
        }
        waiting.lock();
    }
}

view::Outcome Explainer::explain(const std::vector<view::Change>& changes) try {
    std::string pixel;
    std::vector<std::string> options;
    for (const view::Change& change : changes) {
        if (change.option == "--pixel")
            pixel = change.value;
        else
            options.push_back(change.option + "=" + change.value);
    }
    std::ranges::replace(pixel, '\n', ' ');  // so that it stays one request
    const std::lock_guard lock(using_);
    {
        const std::lock_guard waiting(waiting_);
        if (std::exchange(is_outdated_, false)) program_.reset();
        latest_ = Clock::now();
    }
    const bool is_new = !program_ || options_ != options;
    if (is_new) start(options);
    const Clock::time_point end = Clock::now() + k_patience;
    const auto answered = [&] {
        return program_->answer(pixel, std::chrono::duration_cast<milliseconds>(end - Clock::now()));
    };
    std::optional<std::string> answer = answered();
    if (!answer && !is_new && Clock::now() < end) {  // something killed the idle program
        start(options);
        answer = answered();
    }
    if (!answer) {
        std::string why = program_->errors();
        program_.reset();
        if (why.empty()) {
            why = Clock::now() < end ? "The pixel cannot be explained: candela explain ended unexpectedly.\n"
                                     : "The pixel cannot be explained: it took more than a minute.\n";
        }
        return failed(std::move(why));
    }
    if (answer->starts_with("{\"error\"")) return failed(parse_json(*answer)["error"]);
    return {.is_success = true, .content = *std::move(answer)};
} catch (const std::exception& problem) {
    return failed(problem.what());
}
