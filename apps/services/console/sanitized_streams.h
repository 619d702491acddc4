// Makes everything that the command prints safe to print.
#pragma once

#include <cstdint>  // before <memory>, whose std::align depends on it
#include <iosfwd>
#include <memory>

import candela.util;

/// While an instance exists, everything printed through std::cout and std::cerr passes through
/// candela::printable(): valid UTF-8 without terminal control sequences. Line breaks are kept. print_styled()
/// writes coloured text.
class SanitizedStreams {
  public:
    SanitizedStreams();
    SanitizedStreams(const SanitizedStreams&) = delete;
    SanitizedStreams& operator=(const SanitizedStreams&) = delete;
    ~SanitizedStreams();

  private:
    class Filter;
    std::unique_ptr<Filter> out_, err_;
    std::streambuf* before_out_;
    std::streambuf* before_err_;
};
