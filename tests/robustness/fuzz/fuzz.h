// Shared by the fuzzing harnesses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>

import candela.core;

/// Called by libFuzzer, or by the replay of the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// Reports a finding: ends the process with `sentence` unless the condition holds.
void require(bool holds, std::string_view sentence);

std::string_view text_of(const std::uint8_t* data, std::size_t size);

/// This process's file below the directory for temporary files, rewritten for each input.
std::filesystem::path written(const std::string& name, std::string_view content);

/// Whether an independent parser accepts it.
bool is_json(const std::string& text);

/// Invariants of all diagnostics, whatever was read: places lie in their files, text is safe on a terminal,
/// JSON is valid, and there is an error if nothing was returned.
void check_diagnostics(const candela::Diagnostics& diagnostics, bool returned_something);

/// Every number of a valid scene is usable.
void check_finite(const candela::Scene& scene);

/// Draws values from a range of bytes; zeros after its end.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    bool empty() const { return rest_.empty(); }

    template <class T>
    T take() {
        T value{};
        const std::size_t count = rest_.size() < sizeof(T) ? rest_.size() : sizeof(T);
        if (count > 0) std::memcpy(&value, rest_.data(), count);
        rest_ = rest_.subspan(count);
        return value;
    }

    /// 0 … most.
    std::uint32_t at_most(std::uint32_t most) { return take<std::uint8_t>() % (most + 1); }
    bool flag() { return (take<std::uint8_t>() & 1) != 0; }

    /// Small round numbers, numbers of any size, and non-finite ones.
    float number();

  private:
    std::span<const std::uint8_t> rest_;
};

}  // namespace fuzz
