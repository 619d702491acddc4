// The documentation comments of a kernel file: lines that begin with ///, and what they declare.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/kernel_language/model.h"
#include "candela/kernel_language/syntax.h"

namespace candela::kernel_language {

/// A line of a documentation comment, or several that belong together, joined by a blank: without the slashes
/// and the blanks around them.
class CommentText {
  public:
    CommentText(std::string_view line, std::size_t offset);

    void append(const CommentText& line);
    const std::string& text() const { return text_; }
    /// The place in the kernel of a character of the text.
    TextPosition place(std::size_t at = 0) const;

  private:
    std::string text_;
    std::vector<std::pair<std::size_t, std::size_t>> begins_;  // of each line: in the text, in the kernel
};

/// The file's first comment of whole lines that begin with ///; empty if there is none.
std::vector<CommentText> first_comment(std::string_view kernel);

/// The comment behind a declaration, on its line and on the following lines that have nothing else.
/// `declared`: an offset on the declaration's line.
std::optional<CommentText> comment_behind(std::string_view kernel, std::size_t declared);

/// Reads the description of the model: its title, its prose, and what has a keyword. Throws Refusal.
void read_documentation(const std::vector<CommentText>& lines, ModelDeclaration& model);

/// Checks what the comments declare as a scene would: defaults and presets are within their ranges,
/// properties and relations exist, and so on. Throws Refusal.
void check_declarations(const ModelDeclaration& model);

/// Reads what the comment says of the parameter `member`, such as "= 0.2 [0.02, 1]: the width of the
/// highlight". Throws Refusal.
ParameterDeclaration read_parameter(const Variable& member, const std::optional<CommentText>& comment);

}  // namespace candela::kernel_language
