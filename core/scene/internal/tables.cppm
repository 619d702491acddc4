// Reads the tables of a scene in a common way.
module;

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

module candela.scene:tables;

import :fields;
import :document;
import :schema;
import :toml;
import :validation;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

/// The schema of one of the scene's own tables.
const TableSchema& schema_of(std::string_view table);

/// `keys`, and the names of the parameters.
std::vector<std::string> names_in(std::span<const Parameter> schema, std::vector<std::string> keys = {});

/// The parameter of that name, or null.
const Parameter* parameter_named(std::span<const Parameter> schema, std::string_view name);

/// A text, which must be set.
const std::string& text(const ParamSet& set, std::string_view name);
bool has(const ParamSet& set, std::string_view name);

/// The tables of a document, and what applies to all of them.
class SceneTables {
  public:
    SceneTables(const MergedDocument& document, Registry& registry, Diagnostics& diagnostics);

    const TableNode& root() const { return root_; }
    const SourceLocation& whole() const { return whole_; }
    Registry& registry() { return registry_; }
    Diagnostics& diagnostics() { return diagnostics_; }

    /// A table that may occur once; null if it is missing or is not a table, which is reported the first
    /// time.
    const TableNode* single(const std::string& name);
    TableContext context_of(const std::string& name) const;
    /// Reads all keys of a table without a plugin into `to`. If it is not a table, none of them is valid.
    template <class T>
    TableValues read(const Table<T>& table, T& to) {
        const std::string& name = table.about().name;
        TableValues values = read_plain(name, table.schema());
        table.assign(single(name), values.set, to);
        return values;
    }
    /// The installed plugin of that name, or null, with a message at `place`.
    const PluginFile* known(PluginKind kind, const std::string& name, const SourceLocation& place);

  private:
    TableValues read_plain(const std::string& name, const SharedSchema& schema);

    const TableNode& root_;
    SourceLocation whole_;
    Registry& registry_;
    Diagnostics& diagnostics_;
    std::map<std::string, const TableNode*> singles_;
    std::set<std::string> reported_kernels_;
};

}  // namespace candela
