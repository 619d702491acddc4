#include "console/sanitized_streams.h"

#include <cstddef>
#include <iostream>
#include <new>
#include <streambuf>
#include <string>
#include <string_view>

class SanitizedStreams::Filter final : public std::streambuf {
  public:
    explicit Filter(std::streambuf& to) : to_(to) {}

  protected:
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        const char character = traits_type::to_char_type(c);
        return xsputn(&character, 1) == 1 ? c : traits_type::eof();
    }

    std::streamsize xsputn(const char* text, std::streamsize count) override {
        constexpr std::size_t k_much = 1u << 16;
        waiting_.append(text, static_cast<std::size_t>(count));
        // The last character may be incomplete, but not at the end of a line.
        const std::size_t end = waiting_.size() < k_much ? std::string::npos : waiting_.rfind('\n');
        return end == std::string::npos || pass_on(end + 1) ? count : 0;
    }

    /// std::cerr calls this in a destructor, which must not throw.
    int sync() override try {
        return pass_on(waiting_.size()) && to_.pubsync() == 0 ? 0 : -1;
    } catch (const std::bad_alloc&) {
        return -1;
    }

  private:
    bool pass_on(std::size_t count) {
        const std::string text =
            candela::printable(std::string_view(waiting_).substr(0, count), candela::LineBreaks::kept);
        waiting_.erase(0, count);
        const auto size = static_cast<std::streamsize>(text.size());
        return to_.sputn(text.data(), size) == size;
    }

    std::streambuf& to_;
    std::string waiting_;
};

SanitizedStreams::SanitizedStreams()
    : out_(std::make_unique<Filter>(*std::cout.rdbuf())),
      err_(std::make_unique<Filter>(*std::cerr.rdbuf())),
      before_out_(std::cout.rdbuf(out_.get())),
      before_err_(std::cerr.rdbuf(err_.get())) {}

SanitizedStreams::~SanitizedStreams() {
    std::cout.flush();
    std::cerr.flush();
    std::cout.rdbuf(before_out_);
    std::cerr.rdbuf(before_err_);
}
