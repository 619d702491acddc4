// Measures elapsed time.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>

/// Starts when it is constructed.
class Stopwatch {
  public:
    double milliseconds() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "7.3 ms", "1.37 s".
inline std::string duration_text(double milliseconds) {
    return milliseconds < 1000 ? fmt::format("{:.3g} ms", milliseconds)
                               : fmt::format("{:.3g} s", milliseconds / 1000);
}
