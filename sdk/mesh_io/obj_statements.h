// The lines of OBJ and MTL files, and the names of materials in them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/file_bytes.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io {

/// A statement: its first word and the rest of the line, without surrounding blanks.
struct Statement {
    std::string_view keyword, rest;
};

/// Calls `visit` for each line that is neither empty nor a comment; skips a byte order mark. Throws BadFile
/// for UTF-16.
template <class Visit>
void each_statement(std::string_view text, Visit visit) {
    for (TextScanner scanner(without_mark(text)); !scanner.at_end(); scanner.next_line()) {
        const std::string_view keyword = scanner.word_on_line();
        if (!keyword.empty() && keyword.front() != '#') visit(Statement{keyword, scanner.rest_of_line()});
    }
}

/// A material's name, which extends to the end of its line, with one blank between words: it may contain '#'
/// and end in a backslash, such as "Paint #2" and "wood\\".
std::string material_name(std::string_view rest);

/// Numbers materials in the order in which a file names them.
class MaterialNumbers {
  public:
    std::uint32_t of(const std::string& name);

    /// The names by number.
    const std::vector<std::string>& names() const { return names_; }

  private:
    std::map<std::string, std::uint32_t, std::less<>> numbers_;
    std::vector<std::string> names_;
};

/// The statements of an OBJ file about materials.
struct ObjMaterials {
    std::vector<std::string> libraries;  // the rest of each mtllib statement
    MaterialNumbers numbers;             // as in Surface::material; k_no_material: faces without a material
    std::vector<std::string> used;       // in the order of their first faces
};

/// Reads them without the geometry. Throws BadFile for UTF-16.
ObjMaterials materials_of_obj(std::string_view text);

}  // namespace mesh_io
