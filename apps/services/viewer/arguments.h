// The command lines of the verbs that candela view runs: its own arguments, and changes made in the page.
#pragma once

#include <string>
#include <vector>

#include "viewer/request.h"

namespace view {

/// `arguments` without these switches and these options, which have values.
std::vector<std::string> without(const std::vector<std::string>& switches,
                                 const std::vector<std::string>& options,
                                 const std::vector<std::string>& arguments);

/// The changes as options.
std::vector<std::string> options_of(const std::vector<Change>& changes);

/// `arguments`, then `options`. A model that both choose is the one in `options`.
std::vector<std::string> with_options(const std::vector<std::string>& arguments,
                                      const std::vector<std::string>& options);

}  // namespace view
