// What the command prints, wherever it comes from, is text that is safe to print.
#pragma once

#include <iosfwd>
#include <memory>

import candela.text;

/// While one of these lives, std::cout and std::cerr pass everything through candela::printable(): valid
/// UTF-8, and nothing that a terminal obeys. Line breaks are kept. What has colours is written by
/// print_styled().
class PrintableStreams {
  public:
    PrintableStreams();
    PrintableStreams(const PrintableStreams&) = delete;
    PrintableStreams& operator=(const PrintableStreams&) = delete;
    ~PrintableStreams();

  private:
    class Filter;
    std::unique_ptr<Filter> out_, err_;
    std::streambuf* before_out_;
    std::streambuf* before_err_;
};
