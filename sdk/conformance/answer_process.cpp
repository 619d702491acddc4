#include "answer_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <span>

#include "candela/file_descriptor.h"
#include "sandbox.h"

namespace {

constexpr std::size_t k_room = 256UL * 1024 * 1024;
constexpr unsigned k_seconds = 3;  // of processor time, for work that takes milliseconds
constexpr int k_descriptor = 3;

// The memory that the two processes share: words of 32 bits, integers or floats. First the numbers of inputs,
// points and calls, then each call (its name's letters, its parameters, its number of results),
// then the inputs, then room for the results.

class Writer {
  public:
    void integer(std::size_t value) { words_.push_back(static_cast<std::uint32_t>(value)); }
    void number(float value) { words_.push_back(std::bit_cast<std::uint32_t>(value)); }
    void numbers(std::span<const float> all) {
        integer(all.size());
        for (const float each : all) number(each);
    }
    const std::vector<std::uint32_t>& words() const { return words_; }

  private:
    std::vector<std::uint32_t> words_;
};

std::vector<std::uint32_t> message_for(const std::vector<AnswerCall>& calls, const Arrays& in) {
    Writer writer;
    writer.integer(in.arrays());
    writer.integer(in.count());
    writer.integer(calls.size());
    for (const AnswerCall& call : calls) {
        writer.integer(call.name.size());
        for (const char c : call.name) writer.integer(static_cast<unsigned char>(c));
        writer.numbers(call.parameters);
        writer.integer(call.arrays);
    }
    for (std::size_t a = 0; a < in.arrays(); ++a)
        for (std::size_t i = 0; i < in.count(); ++i) writer.number(in[a][i]);
    return writer.words();
}

/// Words that another process can read and write.
class SharedWords {
  public:
    explicit SharedWords(std::size_t count)
        : bytes_(count * sizeof(std::uint32_t)), file_(::memfd_create("candela-answer", MFD_CLOEXEC)) {
        if (!file_.is_open() || ::ftruncate(file_.number(), static_cast<off_t>(bytes_)) != 0) fail();
        at_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file_.number(), 0);
        if (at_ == MAP_FAILED) fail();
    }
    SharedWords(const SharedWords&) = delete;
    SharedWords& operator=(const SharedWords&) = delete;
    ~SharedWords() { ::munmap(at_, bytes_); }
    int file() const { return file_.number(); }
    std::span<std::uint32_t> all() const {
        return {static_cast<std::uint32_t*>(at_), bytes_ / sizeof(std::uint32_t)};
    }

  private:
    static void fail() { FAIL("out of memory: " << std::strerror(errno)); }
    std::size_t bytes_;
    candela::FileDescriptor file_;
    void* at_ = nullptr;
};

/// Reads what message_for() has written.
class Reader {
  public:
    explicit Reader(std::span<std::uint32_t> words) : words_(words) {}
    std::size_t integer() { return words_[at_++]; }
    /// Returns a pointer into the memory itself.
    float* numbers(std::size_t count) {
        auto* const begin = reinterpret_cast<float*>(words_.data() + at_);
        at_ += count;
        return begin;
    }

  private:
    std::span<std::uint32_t> words_;
    std::size_t at_ = 0;
};

struct Job {
    KernelFunctionPointer function = nullptr;
    const float* parameters = nullptr;
    std::vector<float*> out;
};

}  // namespace

ComputedAnswer computed_answer(const std::filesystem::path& library, const std::vector<AnswerCall>& calls,
                               const Arrays& in) {
    const std::vector<std::uint32_t> message = message_for(calls, in);
    std::size_t results = 0;
    for (const AnswerCall& call : calls) results += call.arrays * in.count();
    const SharedWords shared(message.size() + results);
    std::ranges::copy(message, shared.all().data());
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    // The duplicate is not close-on-exec; duplicating a descriptor onto itself only clears that flag.
    ::posix_spawn_file_actions_adddup2(&files, shared.file(), k_descriptor);
    std::string program = "/proc/self/exe", option = k_compute_option, file = library.string();
    char* const words[] = {program.data(), option.data(), file.data(), nullptr};
    pid_t child = 0;
    const int problem = ::posix_spawn(&child, program.c_str(), &files, nullptr, words, environ);
    ::posix_spawn_file_actions_destroy(&files);
    if (problem != 0) FAIL("cannot start a process: " << std::strerror(problem));
    ComputedAnswer answer;
    while (::waitpid(child, &answer.status, 0) < 0 && errno == EINTR) {
    }
    for (const std::uint32_t word : shared.all().subspan(message.size()))
        answer.numbers.push_back(std::bit_cast<float>(word));
    return answer;
}

void compute_answer(const char* library) {
    // It must not inherit the kit's open files.
    static_cast<void>(::close_range(k_descriptor + 1, ~0U, 0));
    struct stat status{};
    if (::fstat(k_descriptor, &status) != 0) ::_exit(k_cannot_be_loaded);
    const auto bytes = static_cast<std::size_t>(status.st_size);
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, k_descriptor, 0);
    void* const loaded = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (memory == MAP_FAILED || loaded == nullptr) ::_exit(k_cannot_be_loaded);
    Reader reader({static_cast<std::uint32_t*>(memory), bytes / sizeof(std::uint32_t)});
    const std::size_t inputs = reader.integer(), count = reader.integer();
    std::vector<Job> jobs(reader.integer());
    std::vector<std::size_t> arrays;
    for (Job& job : jobs) {
        std::string name = "run_";
        for (std::size_t letters = reader.integer(); letters > 0; --letters)
            name += static_cast<char>(reader.integer());
        job.function = reinterpret_cast<KernelFunctionPointer>(::dlsym(loaded, name.c_str()));
        if (job.function == nullptr) ::_exit(k_cannot_be_loaded);
        const std::size_t parameters = reader.integer();
        job.parameters = reader.numbers(parameters);
        arrays.push_back(reader.integer());
    }
    std::vector<const float*> in;
    for (std::size_t a = 0; a < inputs; ++a) in.push_back(reader.numbers(count));
    for (std::size_t i = 0; i < jobs.size(); ++i)
        for (std::size_t a = 0; a < arrays[i]; ++a) jobs[i].out.push_back(reader.numbers(count));
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) ::signal(signal, SIG_DFL);
    confine(k_room, k_seconds);
    for (const Job& job : jobs) job.function(job.parameters, 0, count, in.data(), job.out.data());
    ::_exit(0);
}
