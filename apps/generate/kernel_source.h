// The text of a kernel, and what it declares.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace generate {

/// A member of a kernel's struct.
struct KernelMember {
    std::string type;  // "float", "int", "vec3"
    std::string name;
};

struct KernelStruct {
    std::string name;
    std::vector<KernelMember> members;
};

struct KernelFunction {
    std::string result;
    std::string name;
    std::vector<std::string> parameter_types;
};

/// A kernel as its author wrote it: structs and functions in the common subset of C++ and GLSL.
class KernelSource {
  public:
    KernelSource() = default;
    /// `prefix` and `parameters`: see candela::KernelText.
    KernelSource(std::string text, std::string prefix, std::string parameters);

    const std::string& text() const { return text_; }
    const std::string& prefix() const { return prefix_; }
    /// The struct of the model's parameters, or null where it has none.
    const KernelStruct* parameters() const;
    const std::vector<KernelStruct>& structs() const { return structs_; }

    /// The function <prefix>_<suffix>, or null.
    const KernelFunction* function(std::string_view suffix) const;
    /// A call of that function: with the parameters as `parameters` where it takes them, then `arguments`.
    std::string call(std::string_view suffix, std::string_view parameters, std::string_view arguments) const;

    /// All that it declares at the top: structs, functions.
    std::vector<std::string> names() const;

  private:
    std::string text_, prefix_, parameters_;
    std::vector<KernelStruct> structs_;
    std::vector<KernelFunction> functions_;
};

/// The paragraphs of `library` (parted by empty lines) that declare something which `users`, or a paragraph
/// that is needed itself, speak of, and those that declare nothing.
std::string needed_parts(const std::string& library, const std::string& users);

}  // namespace generate
