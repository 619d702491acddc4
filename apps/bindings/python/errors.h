// Converts the core's errors to Python exceptions.
#pragma once

#include "binding.h"

import candela.util;

namespace candela::python {

/// One entry of an exception's `diagnostics`, or a warning: see candela.Diagnostic.
struct Problem {
    std::string severity, file;
    int line = 0, column = 0, length = 0;
    std::string message, suggestion, text;
};

std::vector<Problem> problems_of(const Diagnostics& diagnostics);

/// Input from Python is invalid: a scene, or the values of a model.
class InvalidInput : public std::runtime_error {
  public:
    enum class What { scene, request };
    InvalidInput(What what, const Diagnostics& diagnostics);
    What what_is_wrong() const noexcept { return what_; }
    const std::vector<Problem>& problems() const noexcept { return problems_; }

  private:
    What what_;
    std::vector<Problem> problems_;
};

/// The message for Python users.
std::string python_message(const Error& error);

}  // namespace candela::python
