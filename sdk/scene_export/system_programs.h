// The programs of this machine, for targets that build and run what they have written.
#pragma once

#include <span>
#include <string>

import candela.api;

namespace candela {

/// Runs programs as this process's user.
class SystemPrograms final : public ProgramRunner {
  public:
    bool has(const char* program) override;
    ProgramResult run(std::span<const char* const> words) override;
    int show(std::span<const char* const> words) override;

  private:
    std::string out_, err_;
};

}  // namespace candela
