// The keys of the scene's own tables. Each is declared once (schema.cpp), with the member that holds its
// value; the schema, reading and writing follow from the declaration.
module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

module candela.scene:fields;

import :animation;
import :content;
import :schema;
import :toml;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

/// A key of a table, and the member of `T` that holds its value.
template <class T>
struct Field {
    Parameter parameter;
    std::function<Value(const T&)> get{};  // null, like `set`: no member holds the value
    std::function<void(T&, const Value&)> set{};
    SourceLocation T::* place = nullptr;        // set to the value's position, if it is given
    bool is_written = true;                     // although it has its default
    bool (*has_no_effect)(const T&) = nullptr;  // in such a `T`

    // The rest of the declaration, after the type of value: real(...).above(0).unit("m").

    Field minimum(float low) const {
        return with([&](Field& f) { f.parameter.minimum = low; });
    }
    Field maximum(float high) const {
        return with([&](Field& f) { f.parameter.maximum = high; });
    }
    Field range(float low, float high) const { return minimum(low).maximum(high); }
    Field above(float low) const {
        return minimum(low).with([](Field& f) { f.parameter.minimum_excluded = true; });
    }
    Field below(float high) const {
        return maximum(high).with([](Field& f) { f.parameter.maximum_excluded = true; });
    }
    Field unit(const char* name) const {
        return with([&](Field& f) { f.parameter.unit = name; });
    }
    Field choices(const std::vector<std::string>& words) const {
        return with([&](Field& f) { f.parameter.choices = words; });
    }
    Field notation(Notation which) const {
        return with([&](Field& f) { f.parameter.notation = which; });
    }
    Field required() const {
        return with([](Field& f) { f.parameter.default_value.reset(); });
    }
    Field placed(SourceLocation T::* member) const {
        return with([&](Field& f) { f.place = member; });
    }
    Field omitted_by_default() const {
        return with([](Field& f) { f.is_written = false; });
    }
    Field without_effect(bool (*when)(const T&)) const {
        return with([&](Field& f) { f.has_no_effect = when; });
    }

  private:
    template <class Change>
    Field with(Change change) const {
        Field result = *this;
        change(result);
        return result;
    }
};

// A member as a value, and back.
inline Value value_of(float x) { return shortest(x); }
inline Value value_of(int x) { return std::int64_t{x}; }
template <class Member>
Value value_of(const Member& x) {
    return x;
}
inline void set_from(const Value& value, float& x) { x = static_cast<float>(std::get<double>(value)); }
inline void set_from(const Value& value, int& x) { x = static_cast<int>(std::get<std::int64_t>(value)); }
template <class Member>
void set_from(const Value& value, Member& x) {
    x = std::get<Member>(value);
}

// Declarations. `meaning` is one sentence; `path` leads from a `T` to the member, whose default is that of
// the key.

template <class T, class First, class... Rest>
Field<T> field(ParamType type, const char* name, const char* meaning, First T::* first, Rest... rest) {
    Field<T> result{.parameter = {.name = name, .type = type, .meaning = meaning},
                    .get = [=](const T& of) { return value_of(((of.*first).*....*rest)); },
                    .set = [=](T& of, const Value& value) { set_from(value, ((of.*first).*....*rest)); }};
    result.parameter.default_value = result.get(T{});
    return result;
}
/// One of `words`, in the order of the enumeration.
template <class T, class First, class... Rest>
Field<T> choice(const std::vector<std::string>& words, const char* name, const char* meaning,
                First T::* first, Rest... rest) {
    Field<T> result{
        .parameter = {.name = name, .type = ParamType::choice, .meaning = meaning, .choices = words},
        .get = [=](const T& of) { return Value(words[static_cast<std::size_t>(((of.*first).*....*rest))]); },
        .set =
            [=](T& of, const Value& value) {
                const auto word = std::ranges::find(words, std::get<std::string>(value));
                auto& member = ((of.*first).*....*rest);
                member = static_cast<std::remove_cvref_t<decltype(member)>>(word - words.begin());
            }};
    result.parameter.default_value = result.get(T{});
    return result;
}
/// Two numbers.
template <class T>
Field<T> pair(const char* name, const char* meaning, std::array<float, 2> T::* member) {
    const auto get = [=](const T& of) -> Value {
        const std::array<float, 2>& numbers = of.*member;
        return NumberList(numbers.begin(), numbers.end());
    };
    return {.parameter = {.name = name,
                          .type = ParamType::numbers,
                          .meaning = meaning,
                          .default_value = get(T{})},
            .get = get,
            .set = [=](T& of, const Value& value) {
                const auto& numbers = std::get<NumberList>(value);
                // The reader reports another number of them.
                if (numbers.size() == 2) of.*member = {numbers[0], numbers[1]};
            }};
}
/// A key whose value needs a reader of its own.
template <class T>
Field<T> unheld(ParamType type, const char* name, const char* meaning) {
    return {.parameter = {.name = name, .type = type, .meaning = meaning}};
}

/// A table of the scene file that describes a `T`.
template <class T>
class Table {
  public:
    /// `about`: without parameters.
    Table(TableSchema about, std::vector<Field<T>> fields)
        : about_(std::move(about)), fields_(std::move(fields)) {
        std::vector<Parameter> held;
        for (const Field<T>& field : fields_) {
            about_.parameters.push_back(field.parameter);
            if (field.set) held.push_back(field.parameter);
        }
        about_.repeated = about_.title.starts_with("[[");
        held_ = std::make_shared<const std::vector<Parameter>>(std::move(held));
    }

    const TableSchema& about() const { return about_; }
    const std::vector<Field<T>>& fields() const { return fields_; }
    /// The keys whose values members hold.
    const SharedSchema& schema() const { return held_; }

    /// Sets the members of `to` that have a value in `values`, of schema(), and their positions in `table`.
    void assign(const TableNode* table, const ParamSet& values, T& to) const {
        std::size_t next = 0;
        for (const Field<T>& field : fields_) {
            if (!field.set) continue;
            if (const auto& value = values.get(next++)) field.set(to, *value);
            const TableNode::Entry* const entry =
                field.place != nullptr && table != nullptr ? table->find(field.parameter.name) : nullptr;
            if (entry != nullptr) to.*field.place = entry->node.place;
        }
    }

  private:
    TableSchema about_;
    std::vector<Field<T>> fields_;
    SharedSchema held_;
};

Table<TextureTransform> texture_transform_table();
Table<NormalMap> normal_map_table();
Table<NormalMap> bump_map_table();
Table<ParameterTexture> texture_table();
Table<ParameterTexture> vertex_attribute_table();

/// All tables but the top of the file.
struct OwnTables {
    Table<Room> room;
    Table<Observer> observer;
    Table<ImageSettings> image;
    Table<ConstraintSettings> constraints;
    Table<ShadowSettings> shadows;
    Table<Model> shading, reflection;  // of objects that name none
    Table<LightSource> light;
    Table<Object> object;
    Table<NormalMap> normal_map, bump_map;
    Table<CommonMaterial> material;     // of any model
    Table<ParameterTexture> texture;    // of a parameter
    Table<ParameterTexture> attribute;  // of the vertices, which gives a parameter
    Table<TextureTransform> texture_transform;
    Table<Orbit> orbit;
    Table<Track> track;
    Table<Animation> animation;
};

const OwnTables& own_tables();

}  // namespace candela
