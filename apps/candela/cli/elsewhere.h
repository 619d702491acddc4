// Marks the parts of the command that `candela` leaves to candela-verbs, so that the first picture after a
// checkout does not wait for them.
#pragma once

#include <exception>

/// Thrown by what this program leaves to candela-verbs (elsewhere.cpp), before it has read or printed
/// anything: main() then becomes candela-verbs.
class Elsewhere : public std::exception {
  public:
    const char* what() const noexcept override { return "candela-verbs does this"; }
};
